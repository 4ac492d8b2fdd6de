// node weight.mjs DIST
// What the page built in DIST loads until its first picture, and what it loads later for the stars. Prints a line of JSON:
// the bytes of each file as they are sent, compressed with gzip.

import { startOnScreen } from './browser.mjs';
import { openPage, ready, servePage } from './page.mjs';

const [dist] = process.argv.slice(2);
if (!dist) {
    throw new Error('usage: node weight.mjs DIST');
}
const server = await servePage(dist);
const browser = await startOnScreen();
try {
    const page = await openPage(browser, server, '?sky=stars', []);
    await page.waitForFunction(() => performance.getEntriesByName('first-picture').length > 0);
    await page.waitForFunction(() =>
        performance.getEntriesByType('resource').some((one) => one.name.endsWith('hipparcos.stars') && one.responseEnd > 0),
    );
    const later = await page.evaluate(() => {
        const first = performance.getEntriesByName('first-picture')[0].startTime;
        const files = performance.getEntriesByType('resource').filter((one) => one.startTime >= first);
        return files.map((one) => new URL(one.name).pathname.split('/').at(-1));
    });
    const sent = Object.entries(server.sent);
    const before = Object.fromEntries(sent.filter(([name]) => !later.includes(name)));
    const after = Object.fromEntries(sent.filter(([name]) => later.includes(name)));
    console.log(JSON.stringify({ before, after }));
} finally {
    await browser.close();
    server.close();
}
