// Runs in the page: the module of kit/three with three.js, which mixes the row of each radius itself.

import * as THREE from 'three';
import { WIDTH, rayLines, send } from './io.js';

const FRAGMENT = (glsl, call) => /* glsl */ `
    uniform highp sampler2D rays;
    uniform highp sampler2D data;
    uniform int first;
    uniform int end;
    ${glsl}
    void main() {
        ivec2 at = ivec2(gl_FragCoord.xy);
        int ray = at.y * ${WIDTH} + at.x;
        if (ray < first || ray >= end) {
            discard;
        }
        vec4 start = texelFetch(rays, ivec2(2 * at.x, at.y), 0);
        float r = start.x;
        vec3 d = start.yzw;
        vec3 hole = texelFetch(rays, ivec2(2 * at.x + 1, at.y), 0).xyz;
        gl_FragColor = vec4(${call}, 1.0);
    }`;

export async function run(job) {
    const { glsl, loadAtlas, mixRow, rowTexture } = await import(job.module);
    const atlas = await loadAtlas();
    const { height, lines } = await rayLines(job);
    const rays = new THREE.DataTexture(lines, 2 * WIDTH, height, THREE.RGBAFormat, THREE.FloatType);
    rays.needsUpdate = true;
    // The module without mixRow gives the atlas as a texture.
    const data = mixRow ? rowTexture(mixRow(atlas, job.rows[0].r)) : atlas;

    const renderer = new THREE.WebGLRenderer();
    renderer.autoClear = false;
    const material = new THREE.ShaderMaterial({
        uniforms: { rays: { value: rays }, data: { value: data }, first: { value: 0 }, end: { value: 0 } },
        vertexShader: 'void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }',
        fragmentShader: FRAGMENT(glsl, job.call),
        blending: THREE.NoBlending,
        depthTest: false,
    });
    const triangle = new THREE.BufferGeometry();
    triangle.setAttribute('position', new THREE.Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3));
    const mesh = new THREE.Mesh(triangle, material);
    mesh.frustumCulled = false;
    const scene = new THREE.Scene().add(mesh);
    const target = new THREE.WebGLRenderTarget(WIDTH, height, {
        type: THREE.FloatType,
        minFilter: THREE.NearestFilter,
        magFilter: THREE.NearestFilter,
        depthBuffer: false,
    });
    renderer.setRenderTarget(target);
    renderer.clear();
    target.scissorTest = true;
    for (const { r, first, count } of job.rows) {
        if (mixRow) {
            mixRow(atlas, r, data.image.data);
            data.needsUpdate = true;
        }
        const end = first + count;
        material.uniforms.first.value = first;
        material.uniforms.end.value = end;
        const line = Math.floor(first / WIDTH);
        target.scissor.set(0, line, WIDTH, Math.ceil(end / WIDTH) - line);
        renderer.setRenderTarget(target);
        renderer.render(scene, new THREE.Camera());
    }
    const numbers = new Float32Array(4 * WIDTH * height);
    renderer.readRenderTargetPixels(target, 0, 0, WIDTH, height, numbers);
    renderer.dispose();
    renderer.forceContextLoss();
    await send(job, numbers);
    return { status: 'ok', log: '' };
}
