// node run.mjs JOBS.json
// Computes directions on the sky with the shaders of kit/ in a browser: GLSL and three.js with WebGL2, WGSL with
// WebGPU. JOBS.json is a list of jobs; README.md of this folder describes them. Prints one line of JSON; the exit code
// is 1 if a job fails.

import { readFile, stat, writeFile } from 'node:fs/promises';
import { dirname, resolve } from 'node:path';
import { HERE, THREE, open, serve, start } from './browser.mjs';

const RAY_BYTES = 32;
const MODULES = { glsl: 'webgl.js', three: 'three_job.js', wgsl: 'webgpu.js' };

const errors = [];
const routes = {
    '/': `${HERE}/`,
    '/three/': `${THREE}/`,
    '/run.html': () => '<!doctype html><link rel="icon" href="data:,"><script type="importmap">'
        + '{ "imports": { "three": "/three/build/three.module.js" } }</script>',
};

/** The job as the page needs it: addresses for paths. Says what is wrong with the job. */
async function prepare(job, index) {
    const at = (name) => `/jobs/${index}/${name}`;
    const { size } = await stat(job.rays);
    if (size === 0 || size % RAY_BYTES !== 0) {
        throw new Error(`${job.rays}: ${size} bytes, not a whole number of rays`);
    }
    const rays = size / RAY_BYTES;
    const rows = job.rows ?? [{ first: 0, count: rays, data: job.data ?? null }];
    let next = 0;
    for (const { first, count } of rows) {
        if (first !== next || !(count > 0)) {
            throw new Error(`rows: the rays ${first} to ${first + count} come after ${next} rays`);
        }
        next += count;
    }
    if (next !== rays) {
        throw new Error(`rows: ${next} of ${rays} rays`);
    }
    if (!(job.kind in MODULES)) {
        throw new Error(`kind: ${job.kind}`);
    }
    routes[at('rays')] = resolve(job.rays);
    routes[at('source')] = resolve(job.source);
    routes[at('module/')] = `${dirname(resolve(job.source))}/`;
    rows.forEach((row, i) => {
        if (row.data) {
            routes[at(`row${i}`)] = resolve(row.data);
        }
    });
    return {
        call: job.call,
        count: rays,
        rays: at('rays'),
        source: at('source'),
        module: at(`module/${job.source.split('/').at(-1)}`),
        texture: { width: job.width, height: job.height, channels: job.channels, type: job.type, filter: job.filter },
        rows: rows.map((row, i) => ({ ...row, data: row.data ? at(`row${i}`) : null })),
        result: at('result'),
        script: `/${MODULES[job.kind]}`,
    };
}

const jobs = JSON.parse(await readFile(process.argv[2], 'utf8'));
const server = await serve(routes);
const browser = await start();
const report = { browser: browser.version(), webgl: null, webgpu: null, jobs: [] };
try {
    const page = await open(browser, `${server.url}/run.html`, errors);
    Object.assign(report, await page.evaluate(async () => (await import('/adapters.js')).adapters()));
    for (const [index, job] of jobs.entries()) {
        const begin = Date.now();
        const done = { name: job.name ?? job.source, kind: job.kind };
        let result = null;
        try {
            const prepared = await prepare(job, index);
            routes[prepared.result] = (body) => {
                result = body;
                return '';
            };
            Object.assign(done, await page.evaluate(async (job) => {
                try {
                    return await (await import(job.script)).run(job);
                } catch (error) {
                    return { status: 'error', message: String(error?.stack ?? error) };
                }
            }, prepared));
            if (done.status === 'ok') {
                if (result?.length !== 12 * prepared.count) {
                    throw new Error(`${result?.length} bytes of result for ${prepared.count} rays`);
                }
                await writeFile(job.out, result);
            }
        } catch (error) {
            Object.assign(done, { status: 'error', message: String(error) });
        }
        if (done.status === 'ok' && errors.length > 0) {
            Object.assign(done, { status: 'error', message: errors.join('\n') });
        }
        errors.length = 0;
        report.jobs.push({ ...done, seconds: (Date.now() - begin) / 1000 });
    }
} finally {
    await browser.close();
    server.close();
}
console.log(JSON.stringify(report));
process.exit(report.jobs.some(({ status }) => status === 'error') ? 1 : 0);
