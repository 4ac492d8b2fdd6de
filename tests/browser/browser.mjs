// Starts Chromium with WebGL2 and WebGPU in software, and serves files to it.

import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { dirname, extname, join, resolve, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

/** Folder of these scripts. */
export const HERE = dirname(fileURLToPath(import.meta.url));

/** Folder of the package three. */
export const THREE = resolve(dirname(createRequire(import.meta.url).resolve('three')), '..');

const TYPES = {
    '.html': 'text/html; charset=utf-8',
    '.js': 'text/javascript; charset=utf-8',
    '.mjs': 'text/javascript; charset=utf-8',
    '.png': 'image/png',
    '.jpg': 'image/jpeg',
    '.css': 'text/css; charset=utf-8',
    '.wasm': 'application/wasm',
};

/**
 * Starts the browser without a screen; the variable CHROMIUM names another program than Debian's. Of a canvas drawn with
 * WebGPU a browser without a screen takes empty screenshots: `startOnScreen` does not.
 */
export async function start() {
    return launch(true, ['--use-webgpu-adapter=swiftshader', '--enable-features=Vulkan']);
}

/** As `start`, on the screen of the variable DISPLAY, which may be virtual. */
export async function startOnScreen() {
    return launch(false, [
        '--enable-features=Vulkan',
        '--use-vulkan=swiftshader',
        '--ignore-gpu-blocklist',
        '--disable-vulkan-surface',
    ]);
}

async function launch(headless, more) {
    const args = [
        '--no-sandbox',
        '--disable-quic',
        '--no-first-run',
        '--disable-background-networking',
        '--disable-component-update',
        '--disable-sync',
        '--use-gl=angle',
        '--use-angle=swiftshader',
        '--enable-unsafe-swiftshader',
        '--enable-unsafe-webgpu',
        ...more,
    ];
    return chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', headless, args });
}

/**
 * Serves on an unused port of this machine. `routes` maps the beginning of a path to a folder (both end in '/'; the
 * longest beginning counts), a whole path to a file, or a whole path to a function that gets the body of the request
 * and returns the answer.
 */
export async function serve(routes) {
    const server = createServer(async (request, response) => {
        try {
            const path = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
            const body = await answer(routes, path, request);
            response.writeHead(200, { 'Content-Type': TYPES[extname(path)] ?? 'application/octet-stream' });
            response.end(body);
        } catch (error) {
            response.writeHead(404, { 'Content-Type': 'text/plain' });
            response.end(String(error));
        }
    });
    await new Promise((done) => server.listen(0, '127.0.0.1', done));
    return { url: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}

async function answer(routes, path, request) {
    if (typeof routes[path] === 'function') {
        const chunks = [];
        for await (const chunk of request) {
            chunks.push(chunk);
        }
        return routes[path](Buffer.concat(chunks));
    }
    if (path in routes && !path.endsWith('/')) {
        return readFile(routes[path]);
    }
    const starts = Object.keys(routes).filter((start) => start.endsWith('/') && path.startsWith(start));
    const longest = starts.sort((a, b) => b.length - a.length)[0];
    if (longest !== undefined) {
        const file = join(routes[longest], path.slice(longest.length) || 'index.html');
        if (file.startsWith(resolve(routes[longest]) + sep)) {
            return readFile(file);
        }
    }
    throw new Error(`${path}: nothing here`);
}

/**
 * Opens a page that gets the package three from this machine. Anything else outside is refused, also another version
 * of three than the installed one. What goes wrong in the page is pushed to `errors`.
 */
export async function open(browser, url, errors, viewport = { width: 960, height: 540 }) {
    const page = await browser.newPage({ viewport, deviceScaleFactor: 1 });
    page.setDefaultTimeout(120000); // a busy machine draws slowly in software
    page.on('pageerror', (error) => errors.push(String(error.stack ?? error)));
    page.on('console', (message) => {
        if (message.type() === 'error') {
            errors.push(message.text());
        }
    });
    const { version } = JSON.parse(await readFile(join(THREE, 'package.json'), 'utf8'));
    const package_ = `https://unpkg.com/three@${version}/`;
    await page.route(/^https?:/, (route) => {
        const wanted = route.request().url();
        if (wanted.startsWith(package_)) {
            return route.fulfill({ path: join(THREE, wanted.slice(package_.length)) });
        }
        return wanted.startsWith(new URL(url).origin + '/') ? route.continue() : route.abort();
    });
    await page.goto(url);
    return page;
}

/** Pixels of a PNG, { width, height, data: RGBA }, read by the browser as they are stored. */
export async function pixels(browser, png) {
    const page = await browser.newPage();
    try {
        const { width, height, text } = await page.evaluate(async (base64) => {
            const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
            const options = { colorSpaceConversion: 'none', premultiplyAlpha: 'none' };
            const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }), options);
            const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
            context.drawImage(bitmap, 0, 0);
            const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
            let text = '';
            for (let at = 0; at < data.length; at += 0x8000) {
                text += String.fromCharCode(...data.subarray(at, at + 0x8000));
            }
            return { width: bitmap.width, height: bitmap.height, text: btoa(text) };
        }, png.toString('base64'));
        return { width, height, data: Buffer.from(text, 'base64') };
    } finally {
        await page.close();
    }
}

/** Differences of the colours of two pictures of one size, in 1/255: mean, 99.9th percentile and largest. */
export function difference(a, b) {
    if (a.width !== b.width || a.height !== b.height) {
        throw new Error(`${a.width} x ${a.height} and ${b.width} x ${b.height} pixels`);
    }
    const all = [];
    for (let i = 0; i < a.data.length; i++) {
        if (i % 4 !== 3) {
            all.push(Math.abs(a.data[i] - b.data[i]));
        }
    }
    const sorted = Float64Array.from(all).sort();
    const mean = sorted.reduce((sum, x) => sum + x, 0) / sorted.length;
    return { mean, p999: sorted[Math.floor(0.999 * sorted.length)], max: sorted.at(-1) };
}
