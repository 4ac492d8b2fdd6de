// Makes and reads skies in a worker, so that the page stays responsive, and loads the stars.

export class Skies {
    /** `module` is that of `loadModule`; `say` is called with what went wrong. */
    constructor(module, say) {
        this.module = module;
        this.say = say;
        this.worker = null;
        this.waiting = 0;
        this.round = 0;
        this.last = Promise.resolve();
    }

    /** Whether a sky is being made or read. */
    get busy() {
        return this.waiting > 0;
    }

    /** Makes a built-in sky for a viewer; `done` is called when it is shown. */
    make(name, viewer, done) {
        const { round } = this;
        this.run({ name }, viewer, done).catch((error) => {
            if (round !== this.round) {
                return;
            }
            viewer.skyFailed(name);
            this.say(`The sky ${name} cannot be made: ${error.message}`);
        });
    }

    /** Reads a panorama for a viewer. Rejects if it cannot be used. */
    read(name, bytes, viewer, done) {
        return this.run({ name, bytes }, viewer, done);
    }

    /** Ends what is under way, and forgets what waits. */
    cancel() {
        this.worker?.terminate();
        this.worker = null;
        this.reject?.(new Error('the view was closed'));
        this.reject = null;
        this.waiting = 0;
        this.round += 1;
        this.last = Promise.resolve();
    }

    /** Runs a task after those before it: each takes the memory of a sky. */
    run(task, viewer, done) {
        const { round } = this;
        this.waiting += 1;
        const result = this.last.then(() => round === this.round && this.work(task, viewer, round));
        this.last = result.catch(() => {}).then(() => {
            if (round === this.round) {
                this.waiting -= 1;
            }
        });
        return result.then(() => round === this.round && done());
    }

    async work(task, viewer, round) {
        const worker = new Worker(new URL('./sky-worker.js', import.meta.url), { type: 'module' });
        this.worker = worker;
        try {
            await new Promise((resolve, reject) => {
                this.reject = reject;
                const wanted = () => round === this.round;
                write(worker, { ...task, module: this.module.compiled }, viewer, wanted).then(resolve, reject);
            });
        } finally {
            worker.terminate();
        }
    }

    /** Loads the catalogue of stars for a viewer. */
    async fetchStars(viewer, done) {
        const { round } = this;
        this.waiting += 1;
        try {
            const response = await fetch(new URL('./hipparcos.stars', import.meta.url));
            if (!response.ok) {
                throw new Error(`${response.status} ${response.statusText}`);
            }
            const bytes = new Uint8Array(await response.arrayBuffer());
            if (round === this.round) {
                viewer.takeStars(bytes);
                done();
            }
        } catch (error) {
            this.say(`The stars cannot be loaded: ${error.message}`);
        } finally {
            if (round === this.round) {
                this.waiting -= 1;
            }
        }
    }
}

/** Passes the faces that a worker sends to the viewer, while `wanted()`. */
function write(worker, task, viewer, wanted) {
    return new Promise((resolve, reject) => {
        let writer = null;
        const take = async ({ data }) => {
            if (!wanted()) {
                resolve();
            } else if (data.error !== undefined) {
                reject(new Error(data.error));
            } else if (data.faceTexels !== undefined) {
                writer = await viewer.beginSky(task.name, data.faceTexels);
            } else if (data.texels !== undefined) {
                writer.write(data.level, data.face, data.texels);
            } else {
                viewer.endSky(writer);
                resolve();
            }
        };
        // One message after the other: the first waits for the device.
        let last = Promise.resolve();
        worker.onmessage = (event) => {
            last = last.then(() => take(event)).catch(reject);
        };
        worker.onerror = (event) => reject(new Error(`${task.name}: ${event.message ?? 'the worker failed'}`));
        worker.postMessage(task);
    });
}
