// node compare_page.mjs FOLDER SKY.png PICTURE.png QUERY [OUT.png]
// Opens the page in FOLDER (kit/three) with QUERY, for example "r=10&fov=90", and the panorama SKY.png, as large as
// PICTURE.png, and compares the two, for a PICTURE.png by
//   viewer render -r 10 --fov 90 --size 960x540 -s SKY.png --sampling single -o PICTURE.png
// The viewer leaves light up to 0.8, sRGB 231, as it is, and rolls off what is brighter; the page cuts it off at 1.
// So SKY.png should not exceed 231. Prints one line of JSON: mean, 99.9th percentile and largest difference in
// 1/255, and the share of the pixels that are black in one picture alone. OUT.png gets the picture of the page.

import { readFile, writeFile } from 'node:fs/promises';
import { resolve } from 'node:path';
import { difference, open, pixels, serve, start } from './browser.mjs';

const [folder, sky, expected, query, out] = process.argv.slice(2);
if (!query) {
    throw new Error('usage: node compare_page.mjs FOLDER SKY.png PICTURE.png QUERY [OUT.png]');
}
const errors = [];
let report = {};
const server = await serve({ '/': `${resolve(folder)}/`, '/compared-sky.png': resolve(sky) });
const browser = await start();
try {
    const theirs = await pixels(browser, await readFile(expected));
    const { width, height } = theirs;
    const url = `${server.url}/index.html?${query}&sky=compared-sky.png&panel=0`;
    const page = await open(browser, url, errors, { width, height });
    await page.waitForFunction(() => window.lensbakeFrames > 0);
    await page.waitForTimeout(300);
    const png = await page.screenshot();
    if (out) {
        await writeFile(out, png);
    }
    const ours = await pixels(browser, png);
    const black = ({ data }, i) => data[i] + data[i + 1] + data[i + 2] === 0;
    let oneBlack = 0;
    for (let i = 0; i < ours.data.length; i += 4) {
        oneBlack += black(ours, i) !== black(theirs, i) ? 1 : 0;
    }
    report = { width, height, ...difference(ours, theirs), black: oneBlack / (width * height) };
} catch (error) {
    errors.push(String(error.stack ?? error));
} finally {
    await browser.close();
    server.close();
}
console.log(JSON.stringify({ errors, ...report }));
process.exit(errors.length > 0 ? 1 : 0);
