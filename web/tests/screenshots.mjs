// node screenshots.mjs DIST FOLDER
// Draws the pictures of docs/web: the page built in DIST as a desktop and a phone show it, with WebGPU and with WebGL2.

import { join } from 'node:path';
import { startOnScreen } from './browser.mjs';
import { openPage, ready, servePage, settled } from './page.mjs';

const [dist, folder] = process.argv.slice(2);
if (!folder) {
    throw new Error('usage: node screenshots.mjs DIST FOLDER');
}
const desktop = { viewport: { width: 1280, height: 720 } };
const phone = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, hasTouch: true, isMobile: true };
const PICTURES = [
    ['desktop-webgpu', '?radius=6&motion=orbit&yaw=25&shift=colour&backend=webgpu', desktop, false],
    ['desktop-webgl2', '?radius=10&backend=webgl', desktop, true],
    ['phone-webgpu', '?radius=8&fov=70&backend=webgpu', phone, false],
    ['phone-webgl2', '?radius=0.9&motion=fall&fov=120&sky=starmap&backend=webgl', phone, true],
];

const errors = [];
const server = await servePage(dist);
const browser = await startOnScreen();
try {
    for (const [name, query, context, opens] of PICTURES) {
        const page = await openPage(browser, server, query, errors, context);
        await ready(page);
        await settled(page);
        if (opens && context === phone) {
            await page.locator('#panel-button').tap();
        } else if (opens) {
            await page.locator('summary').click();
            await page.evaluate(() => document.activeElement.blur());
        }
        await page.waitForTimeout(500);
        await page.screenshot({ path: join(folder, `${name}.jpg`), type: 'jpeg', quality: 85 });
        await page.close();
    }
} finally {
    await browser.close();
    server.close();
}
if (errors.length > 0) {
    console.log(errors.join('\n'));
    process.exitCode = 1;
}
