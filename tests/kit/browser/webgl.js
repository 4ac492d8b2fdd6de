// Runs in the page: a GLSL function in a fragment shader of WebGL2.

import { WIDTH, rayLines, send, texels, text } from './io.js';

// Only the precision that every shader sets: the function must bring the rest.
const fragment = (source, call) => `#version 300 es
precision highp float;
uniform highp sampler2D rays;
uniform highp sampler2D data;
uniform highp int first;
uniform highp int end;
layout(location = 0) out vec4 result;
#line 1
${source}
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    highp int ray = at.y * ${WIDTH} + at.x;
    if (ray < first || ray >= end) {
        discard;
    }
    vec4 start = texelFetch(rays, ivec2(2 * at.x, at.y), 0);
    float r = start.x;
    vec3 d = start.yzw;
    vec3 hole = texelFetch(rays, ivec2(2 * at.x + 1, at.y), 0).xyz;
    result = vec4(${call}, 1.0);
}`;

const VERTEX = `#version 300 es
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}`;

export async function run(job) {
    const gl = document.createElement('canvas').getContext('webgl2');
    if (!gl || !gl.getExtension('EXT_color_buffer_float')) {
        return { status: 'skipped', message: 'no WebGL2 with 32-bit float targets' };
    }
    const { type, filter } = job.texture;
    const needed = { 'f32 linear': 'OES_texture_float_linear', 'unorm16 linear': 'EXT_texture_norm16' };
    const extension = needed[`${type} ${filter}`];
    if (extension && !gl.getExtension(extension)) {
        return { status: 'skipped', message: `WebGL lacks ${extension}` };
    }
    try {
        return await compute(gl, job);
    } finally {
        gl.getExtension('WEBGL_lose_context').loseContext();
    }
}

async function compute(gl, job) {
    const program = gl.createProgram();
    const logs = [
        compiled(gl, program, gl.VERTEX_SHADER, VERTEX),
        compiled(gl, program, gl.FRAGMENT_SHADER, fragment(await text(job.source), job.call)),
    ];
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
        throw new Error(gl.getProgramInfoLog(program));
    }
    gl.useProgram(program);

    const { height, lines } = await rayLines(job);
    const limit = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    if (height > limit) {
        throw new Error(`more than ${WIDTH * limit} rays`);
    }
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    bind(gl, program, 'rays', 0, gl.NEAREST);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, 2 * WIDTH, height, 0, gl.RGBA, gl.FLOAT, lines);

    const target = gl.createTexture();
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D, target);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, WIDTH, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
    gl.viewport(0, 0, WIDTH, height);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.SCISSOR_TEST);

    for (const { first, count, data } of job.rows) {
        if (data) {
            bind(gl, program, 'data', 1, job.texture.filter === 'linear' ? gl.LINEAR : gl.NEAREST);
            await upload(gl, data, job.texture);
        }
        const end = first + count;
        gl.uniform1i(gl.getUniformLocation(program, 'first'), first);
        gl.uniform1i(gl.getUniformLocation(program, 'end'), end);
        const line = Math.floor(first / WIDTH);
        gl.scissor(0, line, WIDTH, Math.ceil(end / WIDTH) - line);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
    const numbers = new Float32Array(4 * WIDTH * height);
    gl.readPixels(0, 0, WIDTH, height, gl.RGBA, gl.FLOAT, numbers);
    const error = gl.getError();
    if (error !== gl.NO_ERROR) {
        throw new Error(`WebGL error 0x${error.toString(16)}`);
    }
    await send(job, numbers);
    return { status: 'ok', log: logs.join('') };
}

/** Compiles a shader of the program and returns the compiler's remarks. */
function compiled(gl, program, type, source) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    const log = gl.getShaderInfoLog(shader) ?? '';
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) {
        throw new Error(log);
    }
    gl.attachShader(program, shader);
    return log;
}

/** Binds a new texture, clamped to the edge and without mipmaps, to a uniform. */
function bind(gl, program, name, unit, filter) {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    gl.uniform1i(gl.getUniformLocation(program, name), unit);
}

async function upload(gl, url, texture) {
    const { width, height, channels, type } = texture;
    const norm16 = gl.getExtension('EXT_texture_norm16');
    const formats = {
        f32: { 1: gl.R32F, 2: gl.RG32F, 4: gl.RGBA32F },
        f16: { 1: gl.R16F, 2: gl.RG16F, 4: gl.RGBA16F },
        unorm16: { 1: norm16?.R16_EXT, 2: norm16?.RG16_EXT, 4: norm16?.RGBA16_EXT },
    };
    const types = { f32: gl.FLOAT, f16: gl.HALF_FLOAT, unorm16: gl.UNSIGNED_SHORT };
    const layout = { 1: gl.RED, 2: gl.RG, 4: gl.RGBA }[channels];
    const values = await texels(url, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, formats[type][channels], width, height, 0, layout, types[type], values);
}
