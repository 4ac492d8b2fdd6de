// Runs in the page: reads the input of a job and sends back its result. The rays lie in a texture, two texels a ray,
// and the results in another, one texel a ray, as lines of WIDTH rays.

export const WIDTH = 1024;

export async function bytes(url) {
    const response = await fetch(url);
    if (!response.ok) {
        throw new Error(await response.text());
    }
    return response.arrayBuffer();
}

export async function text(url) {
    return new TextDecoder().decode(await bytes(url));
}

/** The rays, (r, d) and (hole, 0) for each, in whole lines. */
export async function rayLines(job) {
    const rays = new Float32Array(await bytes(job.rays));
    const height = Math.ceil(job.count / WIDTH);
    const lines = new Float32Array(8 * WIDTH * height);
    lines.set(rays);
    return { height, lines };
}

/** Values of a texture as its type wants them; checks how many there are. */
export async function texels(url, { width, height, channels, type }) {
    const kinds = { f32: Float32Array, f16: Uint16Array, unorm16: Uint16Array };
    const values = new kinds[type](await bytes(url));
    if (values.length !== width * height * channels) {
        throw new Error(`${values.length} values for a texture of ${width} x ${height} x ${channels}`);
    }
    return values;
}

/** Sends the directions, the first three of four numbers each. */
export async function send(job, numbers) {
    const directions = new Float32Array(3 * job.count);
    for (let i = 0; i < job.count; i++) {
        directions.set(numbers.subarray(4 * i, 4 * i + 3), 3 * i);
    }
    await fetch(job.result, { method: 'POST', body: directions });
}
