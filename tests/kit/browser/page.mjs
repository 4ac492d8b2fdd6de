// node page.mjs FOLDER OUT.png [QUERY]
// Serves FOLDER (kit/three), opens its page with QUERY, for example "r=10&fov=90", and writes a screenshot of 960 x 540
// pixels. Then it drags, turns the wheel, presses a key, moves a slider, chooses a sky and resizes the window, all from
// the view without QUERY: each must change the picture, and nothing may be drawn while nothing changes. Prints one line
// of JSON; the exit code is 1 if the page fails.

import { writeFile } from 'node:fs/promises';
import { resolve } from 'node:path';
import { difference, open, pixels, serve, start } from './browser.mjs';

const [folder, out, query = ''] = process.argv.slice(2);
if (!out) {
    throw new Error('usage: node page.mjs FOLDER OUT.png [QUERY]');
}
const errors = [];
const report = { errors, changes: {} };
const server = await serve({ '/': `${resolve(folder)}/` });
const browser = await start();
try {
    const page = await open(browser, `${server.url}/index.html?${query}`, errors);
    await page.waitForFunction(() => window.lensbakeFrames > 0);
    const frames = () => page.evaluate(() => window.lensbakeFrames);
    // The pixels of the view alone: the controls change as well.
    const picture = async () => pixels(browser, await page.screenshot({ style: '#panel { visibility: hidden; }' }));
    // Frames drawn in a second, once what was begun is finished.
    const idle = async () => {
        let drawn = 1;
        for (let tries = 0; drawn > 0 && tries < 10; tries++) {
            const before = await frames();
            await page.waitForTimeout(1000);
            drawn = (await frames()) - before;
        }
        return drawn;
    };
    report.idleFrames = await idle();
    await writeFile(out, await page.screenshot());

    if (query) {
        await page.goto(`${server.url}/index.html`);
        await page.waitForFunction(() => window.lensbakeFrames > 0);
    }
    let before = await picture();
    const changed = async (name, act) => {
        const drawn = await frames();
        await act();
        await page.waitForFunction((drawn) => window.lensbakeFrames > drawn, drawn);
        await page.waitForTimeout(300);
        const after = await picture();
        report.changes[name] = difference(before, after).mean;
        before = after;
    };
    await changed('drag', async () => {
        await page.mouse.move(480, 200);
        await page.mouse.down();
        await page.mouse.move(560, 240, { steps: 4 });
        await page.mouse.up();
    });
    await changed('wheel', () => page.mouse.wheel(0, 700));
    await changed('key', () => page.keyboard.press('ArrowRight'));
    await changed('slider', () => page.locator('#r').fill('0.8'));
    await changed('sky', () => page.locator('#sky').selectOption('grid'));
    const drawn = await frames();
    await page.setViewportSize({ width: 640, height: 640 });
    await page.waitForFunction((drawn) => window.lensbakeFrames > drawn, drawn);
    report.resized = await page.evaluate(() => {
        const { width, height } = document.querySelector('canvas');
        return [width, height];
    });
    report.idleFramesAfter = await idle();

    for (const [name, change] of Object.entries(report.changes)) {
        if (!(change > 1)) {
            errors.push(`${name} changes the picture by ${change} of 255`);
        }
    }
    if (report.idleFrames + report.idleFramesAfter > 0) {
        errors.push('frames are drawn while nothing changes');
    }
    if (report.resized.join() !== '640,640') {
        errors.push(`the canvas has ${report.resized} pixels in a window of 640, 640`);
    }
} catch (error) {
    errors.push(String(error.stack ?? error));
} finally {
    await browser.close();
    server.close();
}
console.log(JSON.stringify(report));
process.exit(errors.length > 0 ? 1 : 0);
