// The sky around a black hole: drag to look, wheel for the radius. Parameters of the page, for example
// index.html?r=5&fov=100&yaw=20&pitch=5&sky=panorama.jpg&panel=0
//   r           radius of the observer in Schwarzschild radii, above 1; Infinity is allowed
//   fov         horizontal field of view in degrees
//   yaw, pitch  where to look, in degrees to the right of the hole and above it
//   sky         nebula, grid, or the address of a panorama (equirectangular, its middle behind the hole)
//   panel       0 hides the controls
//   mipmaps     0 shows one point of the sky in each pixel, not the mean over the pixel

import * as THREE from 'three';
import { glsl, loadAtlas, mixRow, rowTexture } from './lensbake.js';
import { NAMES, drawnSky, pictureSky } from './skies.js';

const NEAREST = 1.01;
const FARTHEST = 1000;
const DEFAULT_SKY = 'nebula';
const element = (id) => document.getElementById(id);
const clamp = THREE.MathUtils.clamp;
const parameters = new URLSearchParams(location.search);

const view = { r: 10, fov: 90, yaw: 0, pitch: 0 };
for (const name of Object.keys(view)) {
    const given = Number(parameters.get(name) ?? view[name]);
    view[name] = Number.isNaN(given) ? view[name] : given;
}
if (!(view.r > 1)) {
    element('message').textContent = `r = ${view.r}: an observer at rest is outside the horizon, at r > 1.`;
    view.r = 10;
} else {
    element('message').textContent = '';
}
element('panel').hidden = parameters.get('panel') === '0';

const renderer = new THREE.WebGLRenderer({ canvas: element('view') });
const camera = new THREE.PerspectiveCamera();
camera.rotation.order = 'YXZ';
const atlas = await loadAtlas();
const row = rowTexture(mixRow(atlas, view.r));
let rowRadius = view.r;

const material = new THREE.ShaderMaterial({
    uniforms: {
        sky: { value: null },
        middle: { value: new THREE.Matrix3() },
        row: { value: row },
        r: { value: view.r },
        hole: { value: new THREE.Vector3(0, 0, -1) },
    },
    vertexShader: /* glsl */ `
        varying vec3 d;
        void main() {
            vec3 to = vec3(position.xy / vec2(projectionMatrix[0][0], projectionMatrix[1][1]), -1.0);
            d = to * mat3(viewMatrix); // the inverse of a rotation is its transpose
            gl_Position = vec4(position.xy, 1.0, 1.0);
        }`,
    fragmentShader: /* glsl */ `
        uniform samplerCube sky;
        uniform mat3 middle;
        uniform highp sampler2D row;
        uniform float r;
        uniform vec3 hole;
        varying vec3 d;
        ${glsl}
        void main() {
            vec3 from = lensbake(normalize(d), hole, r, row);
            // Not in a branch: the level of the mipmap comes from the neighbouring pixels.
            gl_FragColor = textureCube(sky, middle * from);
            if (dot(from, from) < 0.5) {
                gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0); // captured by the hole
            }
            #include <tonemapping_fragment>
            #include <colorspace_fragment>
        }`,
    depthTest: false,
    depthWrite: false,
});
// One triangle that covers the screen.
const triangle = new THREE.BufferGeometry();
triangle.setAttribute('position', new THREE.Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3));
const mesh = new THREE.Mesh(triangle, material);
mesh.frustumCulled = false;
const scene = new THREE.Scene().add(mesh);

// Frames drawn so far: nothing is drawn while nothing changes.
window.lensbakeFrames = 0;
let pending = false;

function redraw() {
    if (!pending) {
        pending = true;
        requestAnimationFrame(draw);
    }
}

function draw() {
    pending = false;
    if (material.uniforms.sky.value === null) {
        return;
    }
    if (view.r !== rowRadius) {
        mixRow(atlas, view.r, row.image.data);
        row.needsUpdate = true;
        rowRadius = view.r;
    }
    material.uniforms.r.value = Math.min(view.r, 1e30); // infinity divided by itself is not a number
    const half = Math.tan(THREE.MathUtils.degToRad(view.fov) / 2) / camera.aspect;
    camera.fov = 2 * THREE.MathUtils.radToDeg(Math.atan(half)); // three's is vertical
    camera.updateProjectionMatrix();
    camera.rotation.y = -THREE.MathUtils.degToRad(view.yaw);
    camera.rotation.x = THREE.MathUtils.degToRad(view.pitch);
    renderer.render(scene, camera);
    window.lensbakeFrames++;
}

// The slider is logarithmic in the distance from the horizon.
const SPAN = Math.log((FARTHEST - 1) / (NEAREST - 1));

function change(changes) {
    Object.assign(view, changes);
    view.fov = clamp(view.fov, 1, 170);
    view.pitch = clamp(view.pitch, -90, 90);
    element('r').value = clamp(Math.log((view.r - 1) / (NEAREST - 1)) / SPAN, 0, 1);
    element('r-text').value = view.r < 100 ? view.r.toPrecision(3) : Math.round(view.r);
    element('fov').value = view.fov;
    element('fov-text').value = `${Math.round(view.fov)}°`;
    redraw();
}

function scaleRadius(factor) {
    change({ r: clamp(1 + (view.r - 1) * factor, NEAREST, FARTHEST) });
}

element('r').oninput = (event) => change({ r: 1 + (NEAREST - 1) * Math.exp(SPAN * event.target.value) });
element('fov').oninput = (event) => change({ fov: Number(event.target.value) });

const canvas = renderer.domElement;
canvas.onpointerdown = (event) => canvas.setPointerCapture(event.pointerId);
canvas.onpointermove = (event) => {
    if (canvas.hasPointerCapture(event.pointerId)) {
        const degrees = view.fov / canvas.clientWidth;
        change({ yaw: view.yaw - event.movementX * degrees, pitch: view.pitch + event.movementY * degrees });
    }
};
canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    const factor = Math.exp(0.001 * (event.deltaY || event.deltaX)); // Shift turns a wheel sideways
    if (event.shiftKey) {
        change({ fov: view.fov * factor });
    } else {
        scaleRadius(factor);
    }
}, { passive: false });

const KEYS = {
    ArrowLeft: () => change({ yaw: view.yaw - 0.05 * view.fov }),
    ArrowRight: () => change({ yaw: view.yaw + 0.05 * view.fov }),
    ArrowUp: () => change({ pitch: view.pitch + 0.05 * view.fov }),
    ArrowDown: () => change({ pitch: view.pitch - 0.05 * view.fov }),
    '+': () => scaleRadius(1.1),
    '-': () => scaleRadius(1 / 1.1),
    '[': () => change({ fov: view.fov / 1.1 }),
    ']': () => change({ fov: view.fov * 1.1 }),
};
window.addEventListener('keydown', (event) => {
    // The arrows move a slider that has the focus.
    if (event.key in KEYS && !event.ctrlKey && !event.metaKey && event.target === document.body) {
        event.preventDefault();
        KEYS[event.key]();
    }
});

function resize() {
    renderer.setPixelRatio(devicePixelRatio);
    renderer.setSize(innerWidth, innerHeight, false);
    camera.aspect = innerWidth / innerHeight;
    redraw();
}
window.addEventListener('resize', resize);

// The window may move to a screen of another pixel density.
function watchDensity() {
    matchMedia(`(resolution: ${devicePixelRatio}dppx)`).addEventListener('change', () => {
        resize();
        watchDensity();
    }, { once: true });
}

// A panorama has its middle along +X in three.js; here it is behind the hole, along -Z.
const MIDDLE_AHEAD = new THREE.Matrix3(0, 0, -1, 0, 1, 0, 1, 0, 0);
const MIN_FILTER = parameters.get('mipmaps') === '0' ? THREE.LinearFilter : THREE.LinearMipmapLinearFilter;
let shownSky = null;
let skyTarget = null;

async function showSky(sky) {
    const drawn = NAMES.includes(sky);
    let target;
    try {
        const read = drawn ? drawnSky : pictureSky;
        target = await read(renderer, sky, MIN_FILTER);
    } catch (error) {
        element('message').textContent += ` This picture of the sky cannot be used. ${error.message ?? ''}`;
        return shownSky === null ? showSky(DEFAULT_SKY) : undefined;
    }
    skyTarget?.dispose();
    skyTarget = target;
    shownSky = sky;
    element('sky').value = drawn ? sky : '';
    material.uniforms.sky.value = target.texture;
    material.uniforms.middle.value.copy(drawn ? new THREE.Matrix3() : MIDDLE_AHEAD);
    redraw();
}

element('sky').onchange = (event) => showSky(event.target.value);
window.addEventListener('dragover', (event) => event.preventDefault());
window.addEventListener('drop', (event) => {
    event.preventDefault();
    const file = event.dataTransfer.files[0];
    if (file) {
        element('message').textContent = '';
        showSky(URL.createObjectURL(file));
    }
});
canvas.addEventListener('webglcontextrestored', () => showSky(shownSky));

resize();
watchDensity();
change({});
await showSky(parameters.get('sky') ?? DEFAULT_SKY);
