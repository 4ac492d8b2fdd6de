// node shadertoy.mjs SOURCE OUT.png [X,Y]
// Draws a shader as Shadertoy does, on 960 x 540 pixels, with the mouse held down at X,Y if given, and writes the
// picture. Prints one line of JSON: the compiler's remarks, the shares of black and of different colours; the exit code
// is 1 if the shader does not compile.

import { readFile, writeFile } from 'node:fs/promises';
import { open, pixels, serve, start } from './browser.mjs';

const [source, out, mouse] = process.argv.slice(2);
if (!out) {
    throw new Error('usage: node shadertoy.mjs SOURCE OUT.png [X,Y]');
}
// What Shadertoy puts around the text of a tab, without the inputs for sound and time that nothing here uses.
const fragment = `#version 300 es
#ifdef GL_ES
precision highp float;
precision highp int;
precision mediump sampler3D;
#endif
uniform vec3 iResolution;
uniform float iTime;
uniform vec4 iMouse;
uniform sampler2D iChannel0;
out vec4 shadertoy_colour;
#line 1
${await readFile(source, 'utf8')}
void main() {
    vec4 colour = vec4(1e20);
    mainImage(colour, gl_FragCoord.xy);
    shadertoy_colour = vec4(colour.xyz, 1.0);
}`;

const errors = [];
let report = {};
const server = await serve({
    '/shadertoy.html': () => '<!doctype html><link rel="icon" href="data:,"><style>body { margin: 0 }</style>'
        + '<canvas width="960" height="540" style="display: block"></canvas>',
});
const browser = await start();
try {
    const page = await open(browser, `${server.url}/shadertoy.html`, errors);
    const log = await page.evaluate(([fragment, mouse]) => {
        const gl = document.querySelector('canvas').getContext('webgl2');
        const program = gl.createProgram();
        const vertex = `#version 300 es
            void main() {
                gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
            }`;
        let log = '';
        for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
            const shader = gl.createShader(type);
            gl.shaderSource(shader, text);
            gl.compileShader(shader);
            log += gl.getShaderInfoLog(shader) ?? '';
            if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) {
                throw new Error(log);
            }
            gl.attachShader(program, shader);
        }
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
            throw new Error(gl.getProgramInfoLog(program));
        }
        gl.useProgram(program);
        gl.uniform3f(gl.getUniformLocation(program, 'iResolution'), 960, 540, 1);
        gl.uniform4f(gl.getUniformLocation(program, 'iMouse'), ...(mouse ? [...mouse, ...mouse] : [0, 0, 0, 0]));
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        return log;
    }, [fragment, mouse?.split(',').map(Number) ?? null]);
    await page.waitForTimeout(300);
    const png = await page.screenshot();
    await writeFile(out, png);
    const { data } = await pixels(browser, png);
    const colours = new Set();
    let black = 0;
    for (let i = 0; i < data.length; i += 4) {
        const colour = data.readUIntBE(i, 3);
        black += colour === 0 ? 1 : 0;
        colours.add(colour);
    }
    report = { log, black: black / (data.length / 4), colours: colours.size };
} catch (error) {
    errors.push(String(error.stack ?? error));
} finally {
    await browser.close();
    server.close();
}
console.log(JSON.stringify({ errors, ...report }));
process.exit(errors.length > 0 ? 1 : 0);
