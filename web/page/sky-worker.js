// A worker that makes a built-in sky, or reads a panorama, and sends it face by face.

import { initSync, makeSky, readPanorama } from './lensbake_web.js';

self.onmessage = ({ data: { module, name, bytes } }) => {
    try {
        initSync({ module });
        const sky = bytes === undefined ? makeSky(name, 0) : readPanorama(name, bytes);
        self.postMessage({ faceTexels: sky.faceTexels });
        for (let level = 0; level < sky.levels; level++) {
            for (let face = 0; face < 6; face++) {
                const texels = sky.face(level, face);
                self.postMessage({ level, face, texels }, [texels.buffer]);
            }
        }
        self.postMessage({});
    } catch (error) {
        const text = error instanceof WebAssembly.RuntimeError ? `${name}: too large for this browser` : error.message;
        self.postMessage({ error: text });
    }
};
