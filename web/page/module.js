// Loads the WebAssembly module, once for all viewers of a page.

import init, * as exports from './lensbake_web.js';

let loading;

/** Loads the module: its exports, its memory, and the compiled module for workers. */
export function loadModule(progress) {
    loading ??= load(progress).catch((error) => {
        loading = undefined;
        throw error;
    });
    return loading;
}

async function load(progress) {
    const url = new URL('./lensbake_web_bg.wasm', import.meta.url);
    const response = await fetch(url);
    if (!response.ok) {
        throw new Error(`${url.pathname}: ${response.status} ${response.statusText}`);
    }
    const compiled = await compile(counted(response, progress));
    const { memory } = await init({ module_or_path: compiled });
    return { exports, compiled, memory };
}

/** A response with the same body, of which the bytes that have arrived are told. */
function counted(response, progress) {
    // Of a compressed body only the compressed length is known.
    const total = response.headers.has('Content-Encoding') ? 0 : Number(response.headers.get('Content-Length') ?? 0);
    let loaded = 0;
    const count = new TransformStream({
        transform(chunk, controller) {
            loaded += chunk.byteLength;
            progress(loaded, total);
            controller.enqueue(chunk);
        },
    });
    return new Response(response.body.pipeThrough(count), { headers: { 'Content-Type': 'application/wasm' } });
}

async function compile(response) {
    if (typeof WebAssembly.compileStreaming === 'function') {
        return WebAssembly.compileStreaming(response);
    }
    return WebAssembly.compile(await response.arrayBuffer());
}
