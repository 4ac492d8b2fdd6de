// node soak.mjs DIST MINUTES QUERY
// Uses the page built in DIST for some minutes: it moves all the time, while keys, drags, skies, motions, methods, sizes
// and a file of the user's own change what is drawn. Prints memory every half minute: MiB of JavaScript after garbage
// collection, of WebAssembly, and of all processes of the browser. The exit code is 1 if there is an error, or if memory
// has grown: the last quarter of the time is compared with the one before, by the mean. Before, every way to draw is used for
// the first time, and the memory of WebAssembly grows to what the largest sky needs.

import { readFileSync, readdirSync } from 'node:fs';
import { startOnScreen } from './browser.mjs';
import { openPage, ready, servePage } from './page.mjs';

const [dist, minutes, query = ''] = process.argv.slice(2);
if (!(Number(minutes) >= 2)) {
    throw new Error('usage: node soak.mjs DIST MINUTES [QUERY], at least 2 minutes');
}
/** Growth that counts as flat, by what is measured: a part of the earlier mean. */
const MOST = { script: 0.1, wasm: 0.02, processes: 0.1 };

/** MiB of memory of the processes of the browser, of which shared parts count once. */
function processes() {
    const parents = new Map();
    for (const id of readdirSync('/proc').filter((name) => /^\d+$/.test(name))) {
        try {
            // The name of a program is in parentheses and may contain spaces.
            parents.set(id, readFileSync(`/proc/${id}/stat`, 'utf8').split(') ').at(-1).split(' ')[1]);
        } catch {
            // It has ended.
        }
    }
    const isOurs = (id) => id !== undefined && (id === String(process.pid) || isOurs(parents.get(id)));
    let kib = 0;
    for (const id of [...parents.keys()].filter((id) => id !== String(process.pid) && isOurs(id))) {
        try {
            kib += Number(/^Pss:\s+(\d+)/m.exec(readFileSync(`/proc/${id}/smaps_rollup`, 'utf8'))?.[1] ?? 0);
        } catch {
            // It has ended.
        }
    }
    return kib / 1024;
}

const errors = [];
const server = await servePage(dist);
const browser = await startOnScreen();
const page = await openPage(browser, server, query, errors, { viewport: { width: 640, height: 400 } });
await ready(page);
const session = await page.context().newCDPSession(page);

async function memory() {
    await session.send('HeapProfiler.collectGarbage');
    const { usedSize } = await session.send('Runtime.getHeapUsage');
    const wasm = await page.evaluate(async () => (await (await import('./module.js')).loadModule()).memory.buffer.byteLength);
    return { script: usedSize / 2 ** 20, wasm: wasm / 2 ** 20, processes: processes() };
}

/** A panorama as a file of the user's own. */
const own = () =>
    page.evaluate(async () => {
        const canvas = new OffscreenCanvas(1024, 512);
        const context = canvas.getContext('2d');
        context.fillStyle = `hsl(${360 * Math.random()} 80% 50%)`;
        context.fillRect(0, 0, 1024, 512);
        const blob = await canvas.convertToBlob({ type: 'image/png' });
        await window.lensbake.openFile(new File([blob], `own-${Math.random()}.png`));
    });

const set = (name, value) => page.evaluate(([name, value]) => window.lensbake.set(name, value), [name, value]);
const actions = [
    async () => set('motion', 'rest'),
    async () => set('orbit-speed', '2'),
    async () => {
        await set('radius', 5);
        await page.evaluate(() => window.lensbake.letGo());
        await page.waitForTimeout(3000);
        await page.evaluate(() => window.lensbake.backToLetGo());
    },
    async () => set('motion', 'orbit').then(() => set('true-period', 'on')),
    async () => page.keyboard.press('z'),
    async () => page.keyboard.press('c'),
    async () => page.keyboard.press('v'),
    async () => page.keyboard.press('m'),
    async () => page.keyboard.press('l'),
    async () => page.keyboard.press('Home'),
    async () => page.setViewportSize({ width: 500 + Math.floor(200 * Math.random()), height: 400 }),
    async () => {
        await page.mouse.move(400, 200);
        await page.mouse.down();
        await page.mouse.move(480, 240, { steps: 8 });
        await page.mouse.up();
    },
    async () => page.mouse.wheel(0, Math.random() < 0.5 ? 200 : -200),
    async () => page.evaluate(() => window.lensbake.screenshot()),
    own,
];

const begun = performance.now();
const end = 60000 * Number(minutes);
const samples = [];
let next = 0;
let done = 0;
while (performance.now() - begun < end) {
    await actions[Math.floor(actions.length * Math.random())]();
    done += 1;
    await page.waitForTimeout(300);
    const now = performance.now() - begun;
    if (now >= next) {
        next = now + 30000;
        const sample = await memory();
        samples.push({ at: now, ...sample });
        const shown = Object.entries(sample).map(([name, mib]) => `${name} ${mib.toFixed(1)} MiB`);
        console.log(`${(now / 60000).toFixed(1)} min: ${shown.join(', ')}`);
    }
}
const frames = await page.evaluate(() => window.lensbake.frames);
await browser.close();
server.close();

const mean = (from, to, name) => {
    const some = samples.filter(({ at }) => at >= from * end && at < to * end).map((sample) => sample[name]);
    return some.reduce((sum, mib) => sum + mib, 0) / some.length;
};
const grown = Object.keys(MOST).filter((name) => mean(0.75, 1, name) > (1 + MOST[name]) * mean(0.5, 0.75, name));
console.log(`${done} actions, ${frames} frames, errors: ${JSON.stringify(errors)}, grown: ${JSON.stringify(grown)}`);
process.exitCode = errors.length > 0 || grown.length > 0 ? 1 : 0;
