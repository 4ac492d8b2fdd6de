// node draw.mjs DIST JOBS
// Opens the page built in DIST for each of the jobs of the JSON file JOBS: { query, width, height, shown, read }. Writes
// what the browser shows of the canvas to the file `shown`, and the picture that the page reads back to `read`. Prints a
// line of JSON: the adapter of each job, and errors.

import { readFile, writeFile } from 'node:fs/promises';
import { startOnScreen } from './browser.mjs';
import { openPage, readBack, ready, servePage, settled } from './page.mjs';

const [dist, jobs] = process.argv.slice(2);
if (!jobs) {
    throw new Error('usage: node draw.mjs DIST JOBS');
}
const errors = [];
const adapters = [];
const server = await servePage(dist);
const browser = await startOnScreen();
try {
    for (const { query, width, height, shown, read } of JSON.parse(await readFile(jobs))) {
        const page = await openPage(browser, server, query, errors, { viewport: { width, height } });
        await ready(page);
        await settled(page);
        adapters.push(await page.evaluate(() => `${window.lensbake.backend}: ${window.lensbake.adapter}`));
        await page.evaluate(() => document.body.classList.add('bare'));
        await writeFile(shown, await page.screenshot());
        await writeFile(read, await readBack(page));
        await page.close();
    }
} finally {
    await browser.close();
    server.close();
}
console.log(JSON.stringify({ adapters, errors }));
