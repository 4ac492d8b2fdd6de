
/** Texels of a row, and rows of the atlas. */
export const TEXELS = TEXEL_COUNT;
export const ROWS = ROW_COUNT;

/**
 * Loads the atlas: values and slopes of all rows, array of shape [ROWS][TEXELS][2].
 * @returns {Promise<Float32Array>}
 */
export async function loadAtlas(url = new URL('./DATA_FILE', import.meta.url)) {
    const response = await fetch(url);
    if (!response.ok) {
        throw new Error(`${url}: ${response.status} ${response.statusText}`);
    }
    const bytes = await response.arrayBuffer();
    const size = 2 * ROWS * TEXELS * NUMBER_TYPE.BYTES_PER_ELEMENT;
    if (bytes.byteLength !== size) {
        throw new Error(`${url}: ${bytes.byteLength} bytes, not ${size}`);
    }
    return READ_NUMBERS;
}

/**
 * The row of the observer at rest at r > 1 (in Schwarzschild radii; Infinity is allowed): texels of value and slope,
 * mixed from four rows of the atlas by Lagrange's cubic. At the ends of the atlas all four rows are inside it. Call it
 * when r changes, not for each pixel.
 * @param {Float32Array} atlas - from loadAtlas
 * @param {Float32Array} row - filled and returned
 */
export function mixRow(atlas, r, row = new Float32Array(2 * TEXELS)) {
    if (!(r > 1)) {
        throw new RangeError(`r = ${r}: an observer at rest is outside the horizon, r > 1`);
    }
    const u = 1 / r;
    const position = (Math.atan2(Math.sqrt(u), Math.sqrt(1 - u)) / (Math.PI / 2)) * (ROWS - 1);
    const first = Math.min(Math.max(Math.floor(position) - 1, 0), ROWS - 4);
    const t = position - first;
    const weights = [
        (-(t - 1) * (t - 2) * (t - 3)) / 6,
        (t * (t - 2) * (t - 3)) / 2,
        (-t * (t - 1) * (t - 3)) / 2,
        (t * (t - 1) * (t - 2)) / 6,
    ];
    for (let i = 0; i < 2 * TEXELS; i++) {
        let mixed = 0;
        for (let k = 0; k < 4; k++) {
            mixed += weights[k] * atlas[2 * TEXELS * (first + k) + i];
        }
        row[i] = mixed;
    }
    return row;
}

/** A texture that holds a row: the argument `row` of the GLSL function. Set needsUpdate after mixing another row. */
export function rowTexture(row) {
    const texture = new DataTexture(row, TEXELS, 1, RGFormat, FloatType);
    texture.needsUpdate = true;
    return texture;
}
