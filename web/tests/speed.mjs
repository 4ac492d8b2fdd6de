// node speed.mjs DIST
// How long the page built in DIST takes from navigation to its first picture and to its whole sky, and what a picture costs
// by each way to draw it: medians of three. Prints rows of a table in Markdown.

import { startOnScreen } from './browser.mjs';
import { openPage, ready, servePage, settled } from './page.mjs';

const [dist] = process.argv.slice(2);
if (!dist) {
    throw new Error('usage: node speed.mjs DIST');
}
const ROUNDS = 3;
const PICTURES = 10;
const SIZE = { width: 1920, height: 1080 };
const PAGES = ['backend=webgpu', 'backend=webgpu&pass=fragment', 'backend=webgl'];
const SCENES = [
    ['undeflected, one ray per pixel', 'method=flat&sampling=single'],
    ['table, one ray per pixel', 'sampling=single'],
    ['table, filtered', 'sampling=filtered'],
];

const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
const errors = [];
const server = await servePage(dist);

async function inBrowser(query, work) {
    const browser = await startOnScreen();
    try {
        const page = await openPage(browser, server, query, errors, { viewport: SIZE });
        await ready(page);
        return await work(page);
    } finally {
        await browser.close();
    }
}

/** Time from navigation to the first picture, and to the whole sky at rest, s. */
async function start(query) {
    return inBrowser(query, async (page) => {
        const first = await page.evaluate(() => performance.getEntriesByName('first-picture')[0].startTime);
        const whole = await page.evaluate(async () => {
            while (!window.lensbake.complete) {
                await new Promise((done) => setTimeout(done, 20));
            }
            return performance.now();
        });
        return [first / 1000, whole / 1000];
    });
}

/** Time per pixel of pictures that are drawn and not shown, ns, by the wall clock. */
async function perRay(query) {
    return inBrowser(query, async (page) => {
        await settled(page);
        const times = [];
        for (let round = 0; round < ROUNDS; round++) {
            times.push(await page.evaluate((count) => window.lensbake.time(count), PICTURES));
        }
        return (1e6 * median(times)) / (SIZE.width * SIZE.height);
    });
}

try {
    for (const page of PAGES) {
        const times = [];
        for (let round = 0; round < ROUNDS; round++) {
            times.push(await start(`?radius=10&panel=off&${page}`));
        }
        const [first, whole] = [0, 1].map((i) => median(times.map((one) => one[i])).toFixed(2));
        console.log(`| ${page} | first picture ${first} s | whole sky ${whole} s |`);
    }
    for (const [name, scene] of SCENES) {
        const row = [];
        for (const page of PAGES) {
            row.push((await perRay(`?radius=10&sky=grid&resolution=1&panel=off&${scene}&${page}`)).toFixed(1));
        }
        console.log(`| ${name} | ${row.join(' ns | ')} ns |`);
    }
} finally {
    server.close();
}
if (errors.length > 0) {
    console.log(errors.join('\n'));
    process.exitCode = 1;
}
