// node readme.mjs FOLDER
// Runs the first two programs in FOLDER/README.md (kit/three) with a cube texture from six pictures, and with one from
// a panorama. At r = infinity there is no bending: the picture must be what three.js draws for scene.background. At
// r = 10 its centre must be black. Prints one line of JSON; the exit code is 1 if the programs fail.

import { readFile } from 'node:fs/promises';
import { join, resolve } from 'node:path';
import { open, serve, start } from './browser.mjs';

const folder = resolve(process.argv[2]);
const programs = [...(await readFile(join(folder, 'README.md'), 'utf8')).matchAll(/^```js\n(.*?)^```$/gms)];
const [sky, change] = programs.map((match) => match[1]);

/** The programs between what they assume and a check of what they draw. */
const script = (cube, fix) => `
// A face or a panorama with a colour of its own, brighter to the right and downwards.
function painted(width, height, hue) {
    const canvas = new OffscreenCanvas(width, height);
    const context = canvas.getContext('2d');
    for (let y = 0; y < height; y += 8) {
        for (let x = 0; x < width; x += 8) {
            context.fillStyle = \`hsl(\${hue + 60 * x / width} 60% \${20 + 50 * y / height}%)\`;
            context.fillRect(x, y, 8, 8);
        }
    }
    return canvas;
}
const canvas = document.createElement('canvas');
const renderer = new THREE.WebGLRenderer({ canvas, preserveDrawingBuffer: true });
renderer.setSize(480, 270);
const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(70, 480 / 270, 0.1, 100);
camera.position.set(5, -3, 2);
let background;
let cube;
${cube}
background.colorSpace = THREE.SRGBColorSpace;
background.needsUpdate = true;

function picture() {
    renderer.render(scene, camera);
    const context = new OffscreenCanvas(480, 270).getContext('2d');
    context.drawImage(canvas, 0, 0);
    return context.getImageData(0, 0, 480, 270).data;
}
// The hole need not be where the camera looks.
const angles = [[0.0, 0.0], [0.7, 0.4], [2.5, -0.3], [4.0, 1.2]];
const turn = ([yaw, pitch]) => camera.rotation.set(pitch, yaw, 0, 'YXZ');
scene.background = background;
const flat = angles.map((angle) => (turn(angle), picture()));
scene.background = null;
${fix(sky)}
turn(angles[0]);
const bent = picture();
const centre = [...bent.slice(4 * (135 * 480 + 240), 4 * (135 * 480 + 240) + 3)];
let r = Infinity;
${change}
const differences = angles.map((angle, i) => {
    turn(angle);
    const sum = picture().reduce((sum, x, k) => sum + Math.abs(x - flat[i][k]), 0);
    return sum / (3 * 480 * 270);
});
const bentBy = bent.reduce((sum, x, k) => sum + Math.abs(x - flat[0][k]), 0) / (3 * 480 * 270);
window.report = { centre, bentBy, differences };
`;

const six = `
background = new THREE.CubeTexture([0, 60, 120, 180, 240, 300].map((hue) => painted(256, 256, hue)));
cube = background;`;
const panorama = `
background = new THREE.CanvasTexture(painted(1024, 512, 0));
background.mapping = THREE.EquirectangularReflectionMapping;
background.colorSpace = THREE.SRGBColorSpace;
cube = new THREE.WebGLCubeRenderTarget(512).fromEquirectangularTexture(renderer, background).texture;`;
const unmirrored = (program) => {
    const changed = program.replace('vec3(-from.x, from.yz)', 'from');
    if (changed === program) {
        throw new Error('README.md: no line to change for a panorama');
    }
    return changed;
};
const cases = { cube: script(six, (program) => program), panorama: script(panorama, unmirrored) };
const three = JSON.parse((await readFile(join(folder, 'index.html'), 'utf8'))
    .match(/<script type="importmap">(.*?)<\/script>/s)[1]);

const errors = [];
const report = { errors };
const routes = { '/': `${folder}/` };
for (const [name, module] of Object.entries(cases)) {
    routes[`/${name}.html`] = () => `<!doctype html><link rel="icon" href="data:,">
        <script type="importmap">${JSON.stringify(three)}</script><script type="module" src="./${name}.js"></script>`;
    routes[`/${name}.js`] = () => module;
}
const server = await serve(routes);
const browser = await start();
try {
    for (const name of Object.keys(cases)) {
        const page = await open(browser, `${server.url}/${name}.html`, errors);
        await page.waitForFunction(() => window.report);
        const { centre, bentBy, differences } = await page.evaluate(() => window.report);
        report[name] = { centre, bentBy, differences };
        if (Math.max(...centre) > 0 || !(bentBy > 5) || !(Math.max(...differences) < 1)) {
            errors.push(`${name}: wrong picture`);
        }
    }
} catch (error) {
    errors.push(String(error.stack ?? error));
} finally {
    await browser.close();
    server.close();
}
console.log(JSON.stringify(report));
process.exit(errors.length > 0 ? 1 : 0);
