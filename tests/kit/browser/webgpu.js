// Runs in the page: a WGSL function in a compute shader of WebGPU.

import { bytes, send, texels, text } from './io.js';

const GROUP = 64;

const shader = (source, call) => `${source}
@group(0) @binding(0) var<storage, read> rays: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> results: array<vec4<f32>>;
@group(0) @binding(2) var<uniform> span: vec2<u32>; // first and end
@group(0) @binding(3) var data: texture_2d<f32>;
@group(0) @binding(4) var data_sampler: sampler;
@compute @workgroup_size(${GROUP})
fn compute_directions(@builtin(global_invocation_id) id: vec3<u32>) {
    let ray = span.x + id.x;
    if (ray >= span.y) {
        return;
    }
    let r = rays[2 * ray].x;
    let d = rays[2 * ray].yzw;
    let hole = rays[2 * ray + 1].xyz;
    results[ray] = vec4<f32>(${call}, 1.0);
}`;

export async function run(job) {
    const adapter = await navigator.gpu?.requestAdapter();
    if (!adapter) {
        return { status: 'skipped', message: 'no WebGPU adapter' };
    }
    const { type, filter } = job.texture;
    const requiredFeatures = [];
    if (type === 'f32' && filter === 'linear') {
        requiredFeatures.push('float32-filterable');
    }
    if (type === 'unorm16') {
        requiredFeatures.push('texture-formats-tier1');
    }
    for (const feature of requiredFeatures) {
        if (!adapter.features.has(feature)) {
            return { status: 'skipped', message: `the WebGPU adapter lacks ${feature}` };
        }
    }
    const device = await adapter.requestDevice({ requiredFeatures });
    device.pushErrorScope('validation');
    try {
        return await compute(device, job);
    } finally {
        device.destroy();
    }
}

async function compute(device, job) {
    const module = device.createShaderModule({ code: shader(await text(job.source), job.call) });
    const remarks = (await module.getCompilationInfo()).messages
        .map(({ type, lineNum, linePos, message }) => `${type}: ${lineNum}:${linePos}: ${message}`);
    if (remarks.some((remark) => remark.startsWith('error'))) {
        throw new Error(remarks.join('\n'));
    }
    const filtered = job.texture.filter === 'linear';
    const layout = device.createBindGroupLayout({
        entries: [
            { buffer: { type: 'read-only-storage' } },
            { buffer: { type: 'storage' } },
            { buffer: { type: 'uniform' } },
            { texture: { sampleType: filtered ? 'float' : 'unfilterable-float' } },
            { sampler: { type: filtered ? 'filtering' : 'non-filtering' } },
        ].map((entry, binding) => ({ binding, visibility: GPUShaderStage.COMPUTE, ...entry })),
    });
    const pipeline = await device.createComputePipelineAsync({
        layout: device.createPipelineLayout({ bindGroupLayouts: [layout] }),
        compute: { module, entryPoint: 'compute_directions' },
    });
    const rays = await bytes(job.rays);
    const input = filledBuffer(device, GPUBufferUsage.STORAGE, rays);
    const size = 16 * job.count;
    const output = device.createBuffer({ size, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC });
    const readable = device.createBuffer({ size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
    const mode = filtered ? 'linear' : 'nearest';
    const sampler = device.createSampler({ minFilter: mode, magFilter: mode }); // clamped to the edge

    const encoder = device.createCommandEncoder();
    for (const { first, count, data } of job.rows) {
        const span = filledBuffer(device, GPUBufferUsage.UNIFORM, new Uint32Array([first, first + count]).buffer);
        const texture = await filledTexture(device, data, job.texture);
        const entries = [{ buffer: input }, { buffer: output }, { buffer: span }, texture.createView(), sampler];
        const pass = encoder.beginComputePass();
        pass.setPipeline(pipeline);
        pass.setBindGroup(0, device.createBindGroup({
            layout,
            entries: entries.map((resource, binding) => ({ binding, resource })),
        }));
        pass.dispatchWorkgroups(Math.ceil(count / GROUP));
        pass.end();
    }
    encoder.copyBufferToBuffer(output, 0, readable, 0, size);
    device.queue.submit([encoder.finish()]);
    const error = await device.popErrorScope();
    if (error) {
        throw new Error(error.message);
    }
    await readable.mapAsync(GPUMapMode.READ);
    await send(job, new Float32Array(readable.getMappedRange()));
    return { status: 'ok', log: remarks.join('\n') };
}

function filledBuffer(device, usage, contents) {
    const buffer = device.createBuffer({ size: contents.byteLength, usage, mappedAtCreation: true });
    new Uint8Array(buffer.getMappedRange()).set(new Uint8Array(contents));
    buffer.unmap();
    return buffer;
}

/** The texture of a row or of the atlas; one texel for a function that needs none. */
async function filledTexture(device, url, texture) {
    const usage = GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST;
    if (!url) {
        return device.createTexture({ size: [1, 1], format: 'r16float', usage });
    }
    const { width, height, channels, type } = texture;
    const values = await texels(url, texture);
    const kind = { f32: '32float', f16: '16float', unorm16: '16unorm' }[type];
    const format = { 1: 'r', 2: 'rg', 4: 'rgba' }[channels] + kind;
    const filled = device.createTexture({ size: [width, height], format, usage });
    const bytesPerRow = width * channels * values.BYTES_PER_ELEMENT;
    device.queue.writeTexture({ texture: filled }, values, { bytesPerRow }, [width, height]);
    return filled;
}
