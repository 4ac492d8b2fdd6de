// node use.mjs DIST PANORAMA BAD [CHECK …]
// Uses the page built in DIST as people do, in Chromium: each check opens it anew. PANORAMA is a picture twice as wide as
// high, BAD a picture file that is damaged. Prints a line of JSON with the checks that passed; the exit code is 1 if one
// fails, or the page reports an error.

import assert from 'node:assert/strict';
import { resolve } from 'node:path';
import { difference, pixels, startOnScreen } from './browser.mjs';
import { PATIENCE_MS, openPage, readBack, ready, servePage, settled } from './page.mjs';

const [dist, panorama, bad, ...only] = process.argv.slice(2);
if (!bad) {
    throw new Error('usage: node use.mjs DIST PANORAMA BAD [CHECK …]');
}
const errors = [];
const server = await servePage(dist);
const browser = await startOnScreen();

/** Opens the page and waits for its first picture; the grid is made faster than the nebula. */
async function opened(query = '', context = {}) {
    const page = await openPage(browser, server, `?sky=grid${query}`, errors, context);
    await ready(page);
    return page;
}
const get = (page, name) => page.evaluate((name) => window.lensbake.get(name), name);
const number = async (page, name) => Number(await get(page, name));
const frames = (page) => page.evaluate(() => window.lensbake.frames);
const message = (page) => page.locator('#message').textContent();
const size = (page) => page.evaluate(() => {
    const canvas = document.getElementById('view');
    return [canvas.width, canvas.height];
});
/** Waits until a condition of the page holds. */
const until = (page, condition, argument) => page.waitForFunction(condition, argument);
const search = (page) => page.evaluate(() => location.search);

/** Two touches that move from a place to a place each, in steps. */
async function touch(page, from, to, steps = 8) {
    const session = await page.context().newCDPSession(page);
    const points = (part) =>
        from.map(([x, y], i) => ({ x: x + part * (to[i][0] - x), y: y + part * (to[i][1] - y), id: i }));
    await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: points(0) });
    for (let step = 1; step <= steps; step++) {
        await session.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: points(step / steps) });
    }
    await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
}

/** Makes the tab seem hidden or shown. */
const hide = (page, state) =>
    page.evaluate((state) => {
        Object.defineProperty(document, 'visibilityState', { value: state, configurable: true });
        document.dispatchEvent(new Event('visibilitychange'));
    }, state);

const checks = {
    /** Nothing is drawn while nothing changes. */
    async 'rests'() {
        const page = await opened();
        await settled(page);
        const before = await frames(page);
        await page.waitForTimeout(2000);
        assert.equal(await frames(page), before);
        return page;
    },

    async 'keys'() {
        const page = await opened();
        await page.keyboard.press('o');
        assert.equal(await get(page, 'motion'), 'fall');
        await page.keyboard.down('ArrowUp');
        await page.waitForTimeout(500);
        await page.keyboard.up('ArrowUp');
        await until(page, () => Number(window.lensbake.get('radius')) < 24);
        await page.keyboard.down('d');
        await page.waitForTimeout(300);
        await page.keyboard.up('d');
        await until(page, () => Number(window.lensbake.get('yaw')) > 1);
        await page.keyboard.press('g');
        const radius = await number(page, 'radius');
        await until(page, (before) => Number(window.lensbake.get('radius')) < before, radius);
        await page.keyboard.press('g');
        await page.keyboard.press('z');
        await until(page, () => window.lensbake.get('sky') === 'stars');
        await page.keyboard.press('Home');
        assert.deepEqual([await get(page, 'radius'), await get(page, 'motion')], ['25', 'rest']);
        return page;
    },

    /** Keyframes are set, played and saved. */
    async 'path'() {
        const page = await opened();
        await page.keyboard.press('k');
        await page.keyboard.down('ArrowUp');
        await page.waitForTimeout(500);
        await page.keyboard.up('ArrowUp');
        await settled(page);
        const near = await number(page, 'radius');
        await page.keyboard.press('k');
        await page.keyboard.press('j');
        await until(page, (near) => Number(window.lensbake.get('radius')) > near + 1, near);
        await until(page, () => document.getElementById('message').textContent.includes('the end of the path'));
        assert.ok(Math.abs((await number(page, 'radius')) - near) < 1e-6);
        const download = page.waitForEvent('download');
        await page.keyboard.press('n');
        const path = JSON.parse((await import('node:fs')).readFileSync(await (await download).path(), 'utf8'));
        assert.deepEqual(path.keyframes.map(({ time }) => time), [0, 3]);
        assert.equal(path.keyframes[0].radius, 25);
        const file = (text) => ({ name: 'my.json', mimeType: 'application/json', buffer: Buffer.from(text) });
        await page.locator('#file').setInputFiles(file('{"keyframes": [{"time": 0, "raduis": 3}]}'));
        await until(page, () => /my.json: .*raduis/.test(document.getElementById('message').textContent));
        await page.locator('#file').setInputFiles(file('{"keyframes": [{"time": 0, "radius": 3}, {"time": 1, "yaw": 20}]}'));
        await until(page, () => window.lensbake.get('radius') === '3' && Number(window.lensbake.get('yaw')) === 20);
        return page;
    },

    /** A key that is released while Control is held, or after the focus has moved, moves nothing any more. */
    async 'released keys'() {
        const page = await opened();
        await page.keyboard.down('d');
        await page.keyboard.down('Control');
        await page.keyboard.up('d');
        await page.keyboard.up('Control');
        await settled(page);
        await page.keyboard.down('d');
        await page.locator('#sky').focus();
        await settled(page);
        await page.keyboard.up('d');
        return page;
    },

    /** H hides everything, ? shows the help; Tab moves the focus and keys typed into a field stay there. */
    async 'keys of the page'() {
        const page = await opened();
        await page.keyboard.press('h');
        assert.equal(await page.locator('#panel').isVisible(), false);
        await page.keyboard.press('h');
        assert.equal(await page.locator('#panel').isVisible(), true);
        await page.keyboard.press('?');
        assert.equal(await page.locator('#help').isVisible(), true);
        assert.match(await page.locator('#keys').textContent(), /look away from the hole/);
        await page.keyboard.press('Escape');
        assert.equal(await page.locator('#help').isVisible(), false);
        const field = page.locator('[data-number="radius"]');
        await field.fill('3.25');
        await field.press('Enter');
        assert.equal(await get(page, 'radius'), '3.25');
        await page.keyboard.type('4');
        assert.equal(await get(page, 'motion'), 'rest');
        await page.keyboard.press('Tab');
        assert.equal(await page.evaluate(() => document.activeElement.id), 'motion');
        return page;
    },

    async 'mouse'() {
        const page = await opened();
        await page.mouse.move(700, 300);
        await page.mouse.down();
        await page.mouse.move(605, 300, { steps: 5 });
        await page.mouse.up();
        // A tenth of the width turns by a tenth of the field of view.
        assert.ok(Math.abs((await number(page, 'yaw')) - 8.90625) < 0.3, await get(page, 'yaw'));
        await page.mouse.move(700, 300);
        await page.mouse.down({ button: 'right' });
        await page.mouse.move(600, 340, { steps: 5 });
        await page.mouse.up({ button: 'right' });
        assert.ok((await number(page, 'orbit')) > 10 && (await number(page, 'latitude')) > 3);
        await page.mouse.wheel(0, -300);
        await until(page, () => Number(window.lensbake.get('radius')) < 20);
        await page.keyboard.down('Control');
        await page.mouse.wheel(0, -300);
        await page.keyboard.up('Control');
        await until(page, () => Number(window.lensbake.get('fov')) < 70);
        return page;
    },

    /** One finger looks, two go round the hole, and two that go apart come nearer. */
    async 'touches'() {
        const page = await opened('', { hasTouch: true, isMobile: true, viewport: { width: 390, height: 700 } });
        await touch(page, [[200, 300]], [[120, 300]]);
        await until(page, () => Number(window.lensbake.get('yaw')) > 10);
        assert.equal(await get(page, 'radius'), '25');
        await touch(page, [[150, 300], [250, 300]], [[50, 300], [350, 300]]);
        await until(page, () => Number(window.lensbake.get('radius')) < 12);
        assert.ok(Math.abs(await number(page, 'orbit')) < 1e-9);
        const radius = await number(page, 'radius');
        await touch(page, [[150, 300], [250, 300]], [[70, 300], [170, 300]]);
        await until(page, () => Number(window.lensbake.get('orbit')) > 20);
        assert.ok(Math.abs((await number(page, 'radius')) / radius - 1) < 1e-6);
        return page;
    },

    /** The panel of a phone is a sheet that a button opens. */
    async 'phone'() {
        const page = await opened('', { hasTouch: true, isMobile: true, deviceScaleFactor: 3, viewport: { width: 390, height: 844 } });
        assert.equal(await page.locator('#panel').isVisible(), false);
        await page.locator('#panel-button').tap();
        const box = await page.locator('#panel').boundingBox();
        assert.deepEqual([box.x, box.width, Math.round(box.y + box.height)], [0, 390, 844]);
        assert.ok(box.height < 500);
        await page.locator('#sky').selectOption('starmap');
        assert.equal(await get(page, 'sky'), 'starmap');
        await page.locator('#panel-button').tap();
        assert.equal(await page.locator('#panel').isVisible(), false);
        const wide = await page.evaluate(() => document.documentElement.scrollWidth);
        assert.equal(wide, 390);
        return page;
    },

    /** The canvas has the pixels of the window, at any ratio, and never grows by itself. */
    async 'resize'() {
        const page = await opened('', { deviceScaleFactor: 2, viewport: { width: 640, height: 360 } });
        await settled(page);
        assert.deepEqual(await size(page), [1280, 720]);
        await page.setViewportSize({ width: 500, height: 400 });
        await until(page, () => document.getElementById('view').width === 1000);
        await settled(page);
        assert.deepEqual(await size(page), [1000, 800]);
        await page.waitForTimeout(1000);
        assert.deepEqual(await size(page), [1000, 800]);
        const { width, height } = await pixels(browser, await readBack(page));
        assert.deepEqual([width, height], [1000, 800]);
        return page;
    },

    /** The panel shows and sets the settings. */
    async 'panel'() {
        const page = await opened('&radius=5');
        await page.locator('#motion').selectOption('orbit');
        assert.equal(await get(page, 'motion'), 'orbit');
        await page.locator('#heading').fill('45');
        assert.equal(await get(page, 'heading'), '45');
        await page.locator('#true-period').check();
        await until(page, () => Number(window.lensbake.get('orbit')) > 1);
        await page.locator('#true-period').uncheck();
        await page.locator('#shift').selectOption('colour');
        await page.locator('summary').click();
        await page.locator('#method').selectOption('split');
        assert.equal(await get(page, 'method'), 'split');
        await page.locator('#sampling').selectOption('single');
        assert.equal(await get(page, 'sampling'), 'single');
        await page.locator('#radius').fill('0.5');
        assert.ok(Math.abs((await number(page, 'radius')) - Math.sqrt(1.51 * 2000)) < 0.5);
        await until(page, () => /c$/.test(document.querySelector('#facts dd')?.textContent ?? ''));
        await page.locator('#reset').click();
        assert.deepEqual([await get(page, 'radius'), await get(page, 'motion')], ['25', 'rest']);
        return page;
    },

    /** The disc of an address is drawn; key and panel hide it, show it and change it. */
    async 'disc'() {
        const page = await opened('&radius=15&disc=4,10&inclination=70');
        const shown = async () => {
            await settled(page);
            return pixels(browser, await readBack(page));
        };
        const start = await shown();
        await page.keyboard.press('b');
        assert.equal(await get(page, 'disc'), 'off');
        assert.equal(await page.locator('#disc-inner').isVisible(), false);
        const without = await shown();
        assert.ok(difference(start, without).mean > 2);
        await page.locator('#disc').check();
        assert.equal(await get(page, 'disc'), '4,10');
        assert.equal(difference(start, await shown()).max, 0);
        // A slider stops before the other radius, and a number beyond it is refused.
        await page.locator('#disc-inner').fill('1');
        assert.equal(await get(page, 'disc'), '9.9,10');
        const outer = page.locator('#disc-outer-number');
        await outer.fill('2');
        await outer.press('Enter');
        await until(page, () => document.getElementById('message').textContent.includes('the outer radius 2'));
        await outer.fill('30');
        await outer.press('Enter');
        assert.equal(await get(page, 'disc'), '9.9,30');
        assert.match(await page.locator('#disc-seen-here').textContent(), /inclined by 70/);
        await page.locator('#disc-temperature').fill('0');
        await page.locator('#disc-shift').selectOption('off');
        await until(page, () => location.search.includes('disc=9.9,30&inclination=70&disc-temperature=1000&disc-shift=off'));
        assert.ok(difference(start, await shown()).mean > 2);
        return page;
    },

    /** WebGL 2 draws the disc as WebGPU does. */
    async 'disc, WebGL 2'() {
        const shown = async (backend) => {
            const page = await opened(`&radius=15&disc=4,10&inclination=70&backend=${backend}`);
            await settled(page);
            return [page, await pixels(browser, await readBack(page))];
        };
        const [webgpu, expected] = await shown('webgpu');
        await webgpu.context().close();
        const [page, found] = await shown('webgl');
        assert.ok(difference(expected, found).mean < 0.1);
        return page;
    },

    /** Each control has a name for a screen reader, and the canvas says what it shows. */
    async 'labels'() {
        const page = await opened('&radius=5');
        await until(page, () => document.getElementById('view').ariaLabel?.includes('r = 5.00'));
        const nameless = await page.evaluate(() =>
            [...document.querySelectorAll('input, select, button, output')]
                .filter((one) => !(one.labels?.length || one.ariaLabel || one.textContent.trim()))
                .map((one) => one.outerHTML),
        );
        assert.deepEqual(nameless, []);
        const tree = await page.locator('body').ariaSnapshot();
        for (const part of ['application "The sky around a black hole', 'slider "radius"', 'combobox "motion"', 'button "Reset"']) {
            assert.ok(tree.includes(part), `${part} is not in\n${tree}`);
        }
        return page;
    },

    /** An address gives the settings back, and follows them. */
    async 'address'() {
        const page = await opened('&radius=4&motion=-0.25,0.5&yaw=30&shift=brightness&method=split&divider=0.25');
        const settings = () => page.evaluate(() => window.lensbake.settings());
        const before = await settings();
        assert.deepEqual(before, {
            radius: '4', motion: '-0.25,0.5', yaw: '30', shift: 'brightness', method: 'split', divider: '0.25', sky: 'grid',
        });
        await page.keyboard.press('m');
        await page.keyboard.press('c');
        await until(page, () => /shift=colour.*method=difference/.test(location.search));
        assert.equal(
            await search(page),
            '?radius=4&motion=-0.25,0.5&yaw=30&shift=colour&method=difference&divider=0.25&sky=grid',
        );
        const changed = await settings();
        await page.reload();
        await ready(page);
        assert.deepEqual(await settings(), changed);
        return page;
    },

    /** A typo and an impossible value are told, and the rest of the address holds. */
    async 'typo'() {
        const page = await opened('&raduis=3&fov=60');
        assert.match(await message(page), /no setting 'raduis'/);
        assert.equal(await get(page, 'fov'), '60');
        await page.goto(`${server.url}?sky=grid&radius=0.5&fov=50`);
        await ready(page);
        await until(page, () => document.getElementById('message').textContent.includes('above the horizon'));
        assert.deepEqual([await get(page, 'radius'), await get(page, 'fov')], ['25', '50']);
        await page.goto(`${server.url}?sky=grdi`);
        await ready(page);
        assert.match(await message(page), /sky is 'grdi', but must be nebula/);
        await page.goto(`${server.url}?sky=grid&backend=webgp`);
        await ready(page);
        assert.match(await message(page), /backend is 'webgp', but must be auto, webgpu, webgl/);
        await page.goto(`${server.url}?sky=grid&disc=2,12&inclination=60`);
        await ready(page);
        await until(page, () => document.getElementById('message').textContent.includes('the inner radius 2 is below 3'));
        assert.deepEqual([await get(page, 'disc'), await get(page, 'inclination')], ['3,12', '60']);
        await page.goto(`${server.url}?sky=grid&disc=3`);
        await ready(page);
        assert.match(await message(page), /disc is '3', but must be off, on, or its inner and outer radius/);
        return page;
    },

    /** A panorama of the user's own, dropped and chosen; a damaged file leaves the picture as it is. */
    async 'files'() {
        const page = await opened('&radius=5');
        await settled(page);
        const before = await pixels(browser, await readBack(page));
        const drop = await page.evaluateHandle(async (base64) => {
            const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
            const transfer = new DataTransfer();
            transfer.items.add(new File([bytes], 'own.png', { type: 'image/png' }));
            return transfer;
        }, (await import('node:fs')).readFileSync(panorama).toString('base64'));
        await page.dispatchEvent('body', 'drop', { dataTransfer: drop });
        await until(page, () => window.lensbake.get('sky') === 'own.png');
        await settled(page);
        const after = await pixels(browser, await readBack(page));
        assert.ok(difference(before, after).mean > 5);
        await page.locator('#file').setInputFiles(resolve(bad));
        await until(page, () => document.getElementById('message').textContent.includes('bad.png'));
        assert.equal(await get(page, 'sky'), 'own.png');
        const still = await pixels(browser, await readBack(page));
        assert.equal(difference(after, still).max, 0);
        // Its name is not in the address: another reader does not have the file.
        await page.waitForTimeout(1000);
        assert.equal(await search(page), '?radius=5');
        return page;
    },

    /** A hidden tab draws nothing, and time does not pass in it. */
    async 'hidden tab'() {
        const page = await opened('&orbit-speed=4');
        await until(page, () => Number(window.lensbake.get('orbit')) > 2);
        await hide(page, 'hidden');
        await page.waitForTimeout(200);
        const [before, orbit] = [await frames(page), await number(page, 'orbit')];
        await page.waitForTimeout(1500);
        assert.equal(await frames(page), before);
        await hide(page, 'visible');
        await until(page, (before) => window.lensbake.frames > before + 1, before);
        assert.ok((await number(page, 'orbit')) - orbit < 0.9 * 1.5 * 48);
        return page;
    },

    async 'less motion'() {
        const page = await opened('&orbit-speed=4', { reducedMotion: 'reduce' });
        await settled(page);
        assert.match(await message(page), /asks for less motion/);
        const before = await frames(page);
        await page.waitForTimeout(1000);
        assert.equal(await frames(page), before);
        return page;
    },

    /** The resolution falls while the view moves too slowly, and is whole again at rest. */
    async 'automatic resolution'() {
        const page = await opened('&radius=3&frame-time=4&backend=webgl', { viewport: { width: 1280, height: 960 } });
        await settled(page);
        const [width] = await page.evaluate(() => window.lensbake.panel().picture);
        assert.equal(width, 1280);
        await page.evaluate(() => window.lensbake.set('orbit-speed', '1'));
        await until(page, () => window.lensbake.panel().picture[0] < 800);
        await page.evaluate(() => window.lensbake.set('orbit-speed', '0'));
        await until(page, () => window.lensbake.panel().picture[0] === 1280);
        return page;
    },

    /** A picture is saved as PNG, as the canvas shows it. */
    async 'picture'() {
        const page = await opened('&radius=5&panel=off');
        await settled(page);
        const download = page.waitForEvent('download');
        await page.keyboard.press('p');
        const file = await (await download).path();
        assert.equal((await download).suggestedFilename(), 'lensbake-1.png');
        const saved = await pixels(browser, (await import('node:fs')).readFileSync(file));
        await page.evaluate(() => document.body.classList.add('bare'));
        assert.equal(difference(saved, await pixels(browser, await page.screenshot())).max, 0);
        return page;
    },

    /** A lost context of WebGL is restored: the same settings, the same picture. */
    async 'lost context'() {
        const page = await opened('&radius=5&backend=webgl');
        await settled(page);
        await page.keyboard.press('k');
        const path = await page.evaluate(() => window.lensbake.path());
        assert.match(path, /"radius":5/);
        const before = await pixels(browser, await readBack(page));
        await page.evaluate(async () => {
            const lose = document.getElementById('view').getContext('webgl2').getExtension('WEBGL_lose_context');
            lose.loseContext();
            await new Promise((done) => setTimeout(done, 300));
            lose.restoreContext();
        });
        await until(page, () => window.lensbake.backend === 'webgl' && window.lensbake.complete);
        await settled(page);
        assert.match(await message(page), /was lost; drawing again/);
        assert.equal(await page.evaluate(() => window.lensbake.path()), path);
        assert.equal(difference(before, await pixels(browser, await readBack(page))).max, 0);
        return page;
    },

    /** A sky of the user's own is there again as well. */
    async 'lost context, own sky'() {
        const page = await opened('&radius=5&backend=webgl');
        await page.locator('#file').setInputFiles(resolve(panorama));
        await until(page, () => window.lensbake.get('sky') === 'own.png');
        await settled(page);
        const before = await pixels(browser, await readBack(page));
        await page.evaluate(async () => {
            const lose = document.getElementById('view').getContext('webgl2').getExtension('WEBGL_lose_context');
            lose.loseContext();
            await new Promise((done) => setTimeout(done, 100));
            lose.restoreContext();
        });
        await until(page, () => document.getElementById('message').textContent.includes('was lost; drawing again'));
        await until(page, () => window.lensbake.get('sky') === 'own.png' && window.lensbake.complete);
        await settled(page);
        assert.equal(difference(before, await pixels(browser, await readBack(page))).max, 0);
        return page;
    },

    /** The GPU process is lost under WebGPU: the page opens another device. */
    async 'lost device'() {
        const page = await opened('&radius=5');
        assert.equal(await page.evaluate(() => window.lensbake.backend), 'webgpu');
        await settled(page);
        const before = await pixels(browser, await readBack(page));
        await (await browser.newBrowserCDPSession()).send('Browser.crashGpuProcess');
        await until(page, () => document.getElementById('message').textContent.includes('was lost; drawing again'));
        await until(page, () => window.lensbake.complete);
        await settled(page);
        assert.equal(await get(page, 'radius'), '5');
        const after = await pixels(browser, await readBack(page));
        assert.ok(difference(before, after).mean < 0.5);
        return page;
    },

    /** Without WebGPU the page takes WebGL2; without either it says so in a sentence, with a still picture. */
    async 'no WebGPU'() {
        const page = await opened('', { script: () => Object.defineProperty(navigator, 'gpu', { value: undefined }) });
        assert.equal(await page.evaluate(() => window.lensbake.backend), 'webgl');
        return page;
    },

    async 'neither'() {
        const page = await openPage(browser, server, '', [], {
            script: () => {
                Object.defineProperty(navigator, 'gpu', { value: undefined });
                HTMLCanvasElement.prototype.getContext = () => null;
            },
        });
        await page.locator('#failure').waitFor();
        assert.match(await page.locator('#failure-text').textContent(), /WebGPU.*WebGL 2/);
        await until(page, () => document.getElementById('still').naturalWidth > 0);
        return page;
    },

    /** Stars as points under WebGPU, loaded after the first picture; under WebGL2 the page says that they are left out. */
    async 'stars'() {
        const page = await openPage(browser, server, '?sky=stars&radius=10', errors);
        await ready(page);
        await until(page, () => performance.getEntriesByName(new URL('hipparcos.stars', location).href).length === 1);
        await settled(page);
        const light = async (page) => {
            const { data } = await pixels(browser, await readBack(page));
            return data.reduce((sum, value, i) => sum + (i % 4 < 3 && value > 32 ? 1 : 0), 0);
        };
        assert.ok((await light(page)) > 2000);
        await page.goto(`${server.url}?sky=stars&radius=10&backend=webgl`);
        await ready(page);
        await settled(page);
        assert.match(await message(page), /need WebGPU/);
        assert.equal(await light(page), 0);
        return page;
    },

    /** Two views on a page of one's own; one is removed while the other goes on. */
    async 'embedded'() {
        const page = await openPage(browser, server, 'embed.html', errors);
        await until(page, () => window.views !== undefined);
        await until(page, () => window.views.far.complete && window.views.near.complete);
        assert.equal(await page.evaluate(() => window.views.near.get('motion')), 'fall');
        await page.locator('#radius').fill('0.5');
        assert.equal(await page.evaluate(() => window.views.near.get('radius')), '0.5');
        await page.locator('#far').hover();
        await page.mouse.wheel(0, -300);
        await until(page, () => Number(window.views.far.get('radius')) < 20);
        assert.match(await page.locator('#far-radius').textContent(), /^1\d\.\d\d$/);
        await page.locator('#end').click();
        const png = await page.evaluate(async () => (await window.views.far.screenshot()).size);
        assert.ok(png > 1000);
        assert.equal(await page.evaluate(() => window.views.near.get('radius')), undefined);
        return page;
    },
};

/** Ends a check that waits for something without a limit of its own. */
async function withinLimit(check) {
    let timer;
    const late = new Promise((_, reject) => {
        timer = setTimeout(() => reject(new Error(`not done in ${(3 * PATIENCE_MS) / 1000} s`)), 3 * PATIENCE_MS);
    });
    try {
        return await Promise.race([check(), late]);
    } finally {
        clearTimeout(timer);
    }
}

const passed = [];
const failed = [];
try {
    for (const [name, check] of Object.entries(checks)) {
        if (only.length > 0 && !only.includes(name)) {
            continue;
        }
        errors.length = 0;
        const began = performance.now();
        try {
            const page = await withinLimit(check);
            await page.context().close();
            assert.deepEqual(errors, [], 'errors in the page');
            passed.push(name);
        } catch (error) {
            failed.push(`${name}: ${error.stack}\n${errors.join('\n')}`);
        }
        console.error(`${name}: ${((performance.now() - began) / 1000).toFixed(1)} s`);
    }
} finally {
    await browser.close();
    server.close();
}
console.log(failed.length === 0 ? JSON.stringify({ passed }) : failed.join('\n'));
process.exitCode = failed.length === 0 ? 0 : 1;
