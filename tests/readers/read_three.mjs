// Reads a picture with three.js and writes it to standard output: width and height as u32, then R, G and B
// of each pixel as f32, from the top row to the bottom one, all little-endian. It knows no other channels.

import { readFileSync, writeSync } from 'node:fs';
import { FloatType } from 'three';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';

const file = readFileSync(process.argv[2]);
const bytes = file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength);
// Without setDataType the loader makes half floats.
const { width, height, data } = new EXRLoader().setDataType(FloatType).parse(bytes);
if (!(data instanceof Float32Array) || data.length !== 4 * width * height) {
    throw new Error('not four 32-bit floats a pixel');
}
const out = new DataView(new ArrayBuffer(8 + 12 * width * height));
out.setUint32(0, width, true);
out.setUint32(4, height, true);
let at = 8;
for (let y = 0; y < height; y++) {
    // The loader gives the bottom row first, as WebGL wants it.
    const line = 4 * width * (height - 1 - y);
    for (let x = 0; x < width; x++) {
        for (let channel = 0; channel < 3; channel++, at += 4) {
            out.setFloat32(at, data[line + 4 * x + channel], true);
        }
    }
}
const all = new Uint8Array(out.buffer);
for (let written = 0; written < all.length; ) {
    written += writeSync(1, all, written);
}
