
/** Loads the atlas as a texture: the argument `atlas` of the GLSL function. */
export async function loadAtlas(url = new URL('./DATA_FILE', import.meta.url)) {
    const response = await fetch(url);
    if (!response.ok) {
        throw new Error(`${url}: ${response.status} ${response.statusText}`);
    }
    const bytes = await response.arrayBuffer();
    const size = ROW_COUNT * TEXEL_COUNT * NUMBER_TYPE.BYTES_PER_ELEMENT;
    if (bytes.byteLength !== size) {
        throw new Error(`${url}: ${bytes.byteLength} bytes, not ${size}`);
    }
    const texture = new DataTexture(new NUMBER_TYPE(bytes), TEXEL_COUNT, ROW_COUNT, RedFormat, TEXTURE_TYPE);
    texture.minFilter = LinearFilter;
    texture.magFilter = LinearFilter;
    texture.needsUpdate = true;
    return texture;
}
