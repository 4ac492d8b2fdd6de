// Serves the built page, compressed as a host does, and opens it.

import { createServer } from 'node:http';
import { readFile } from 'node:fs/promises';
import { extname, join, resolve, sep } from 'node:path';
import { gzipSync } from 'node:zlib';

const TYPES = {
    '.html': 'text/html; charset=utf-8',
    '.js': 'text/javascript; charset=utf-8',
    '.css': 'text/css; charset=utf-8',
    '.wasm': 'application/wasm',
    '.jpg': 'image/jpeg',
};

/** Longest wait for one thing: a busy machine draws slowly in software. */
export const PATIENCE_MS = Number(process.env.PATIENCE_MS ?? 120000);

/**
 * Serves a folder below the path /some/folder/ of an unused port, compressed with gzip. `sent` gets the bytes of each
 * answer by the name of its file. `refuse(name)` may name files that are not there.
 */
export async function servePage(folder, refuse = () => false) {
    const root = resolve(folder);
    const sent = {};
    const compressed = new Map();
    const server = createServer(async (request, response) => {
        const path = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
        const name = path.replace(/^\/some\/folder\//, '') || 'index.html';
        const file = join(root, name);
        try {
            if (!path.startsWith('/some/folder/') || !file.startsWith(root + sep) || refuse(name)) {
                throw new Error(`${path}: nothing here`);
            }
            if (!compressed.has(file)) {
                compressed.set(file, gzipSync(await readFile(file), { level: 9 }));
            }
            const body = compressed.get(file);
            sent[name] = body.length;
            response.writeHead(200, {
                'Content-Type': TYPES[extname(file)] ?? 'application/octet-stream',
                'Content-Encoding': 'gzip',
                'Content-Length': body.length,
            });
            response.end(body);
        } catch (error) {
            response.writeHead(404, { 'Content-Type': 'text/plain' });
            response.end(String(error));
        }
    });
    await new Promise((done) => server.listen(0, '127.0.0.1', done));
    return { url: `http://127.0.0.1:${server.address().port}/some/folder/`, sent, close: () => server.close() };
}

/**
 * Opens the page with a query and waits for its first picture. What goes wrong in the page, and every request to
 * elsewhere, is pushed to `errors`.
 */
export async function openPage(browser, server, query, errors, context = {}) {
    const { script, ...more } = context;
    const page = await browser.newPage({ viewport: { width: 960, height: 540 }, deviceScaleFactor: 1, ...more });
    page.setDefaultTimeout(PATIENCE_MS);
    page.on('pageerror', (error) => errors.push(String(error.stack ?? error)));
    page.on('console', (message) => {
        if (message.type() === 'error') {
            errors.push(message.text());
        }
    });
    page.on('request', (request) => {
        if (!request.url().startsWith(server.url) && !/^(blob|data):/.test(request.url())) {
            errors.push(`request to ${request.url()}`);
        }
    });
    if (script !== undefined) {
        await page.addInitScript(script);
    }
    await page.goto(`${server.url}${query}`);
    return page;
}

/** Waits for the first picture. */
export const ready = (page) => page.waitForFunction(() => window.lensbake !== undefined);

/** Waits until the whole sky is there and nothing moves: no frame is drawn for half a second. */
export async function settled(page) {
    await page.waitForFunction(() => window.lensbake.complete);
    await page.evaluate(async (patience) => {
        const end = performance.now() + patience;
        let before = -1;
        while (before !== window.lensbake.frames) {
            if (performance.now() > end) {
                throw new Error('the view does not come to rest');
            }
            before = window.lensbake.frames;
            await new Promise((done) => setTimeout(done, 600));
        }
    }, PATIENCE_MS);
}

/** The bytes of the picture that the view reads back, as PNG. */
export async function readBack(page) {
    const base64 = await page.evaluate(async () => {
        const blob = await window.lensbake.screenshot();
        const bytes = new Uint8Array(await blob.arrayBuffer());
        let text = '';
        for (let at = 0; at < bytes.length; at += 0x8000) {
            text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
        }
        return btoa(text);
    });
    return Buffer.from(base64, 'base64');
}
