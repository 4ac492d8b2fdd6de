// The sky around a black hole on a canvas of your page.
//
//     import { createLensbake } from './lensbake.js';
//     const view = await createLensbake(document.querySelector('canvas'), { settings: { radius: 4 } });
//     view.set('yaw', 30);
//     const png = await view.screenshot();
//     view.destroy();
//
// Nothing is drawn while nothing changes, nor while the tab is hidden.

import { loadModule } from './module.js';
import { listen } from './input.js';
import { Skies } from './skies.js';
import { watchSize } from './size.js';

/** How often a lost device is opened again within RECOVERY_MS before that is given up. */
const RECOVERIES = 3;
const RECOVERY_MS = 60000;
/** Longest time that a browser may take to restore a context of WebGL, ms. */
const RESTORE_MS = 20000;
/** Time until another frame where one is wanted soon, ms. */
const SOON_MS = 300;
/** Largest file that is read, bytes. */
const MOST_BYTES = 512 * 1024 * 1024;

/**
 * Draws the sky around a black hole on `canvas`, whose size is set by the style of the page.
 *
 * Options, all of which may be left out:
 * - `settings`: names and values, as `set` takes them;
 * - `backend`: 'webgpu', 'webgl', or 'auto', the better one that works;
 * - `pass`: 'compute' or 'fragment', the passes that draw (default: compute with WebGPU; WebGL2 has fragment only);
 * - `keys`: the element whose keys control the view (default: the canvas; null: no keys);
 * - `pointer`: whether mouse and touches control it (default: true);
 * - `progress(loaded, total)`: called while the module loads, bytes; `total` is 0 if unknown;
 * - `message(text)`: called with what the user should know;
 * - `drawn()`: called after each frame;
 * - `command(name)`: called for the keys that a page answers: 'full-screen', 'screenshot', 'leave';
 * - `failed(reason)`: called when nothing can be drawn any more.
 *
 * Rejects if neither WebGPU nor WebGL2 can draw here.
 */
export async function createLensbake(canvas, options = {}) {
    const module = await loadModule(options.progress ?? (() => {}));
    const view = new View(canvas, module, options);
    try {
        await view.open();
    } catch (error) {
        view.end();
        throw error;
    }
    return view.handle();
}

class View {
    constructor(canvas, module, options) {
        this.canvas = canvas;
        this.module = module;
        this.options = options;
        this.viewer = null;
        this.last = { ...options.settings };
        this.frames = 0;
        this.request = 0;
        this.timer = 0;
        this.losses = [];
        this.closed = false;
        this.file = null;
        this.stop = [];
        this.skies = new Skies(module, (text) => this.say(text));
    }

    say(text) {
        this.options.message?.(text);
    }

    async open() {
        this.size = watchSize(this.canvas, () => this.redraw());
        this.stop.push(() => this.size.stop());
        const hide = () => this.hiddenOrShown();
        document.addEventListener('visibilitychange', hide);
        this.stop.push(() => document.removeEventListener('visibilitychange', hide));
        const lost = (event) => this.contextLost(event);
        this.canvas.addEventListener('webglcontextlost', lost);
        this.stop.push(() => this.canvas.removeEventListener('webglcontextlost', lost));
        await this.openViewer(this.last);
        this.stop.push(
            listen(this.canvas, this.options, {
                viewer: () => this.viewer,
                ratio: () => this.size.ratio(),
                changed: () => this.redraw(),
                command: (name) => this.options.command?.(name),
            }),
        );
    }

    /** Opens a viewer with these settings; what is wrong with them is said, and the others hold. */
    async openViewer(settings) {
        const { Viewer } = this.module.exports;
        const skies = ['nebula', 'starmap', 'grid', 'stars'];
        const sky = skies.includes(settings.sky) ? settings.sky : 'nebula';
        const { width, height } = this.size.now();
        const backend = this.options.backend ?? 'auto';
        const pass = this.options.pass ?? 'auto';
        const viewer = await Viewer.open(this.canvas, backend, pass, sky, width, height, (reason) => {
            if (this.viewer === viewer) {
                this.lost(reason);
            }
        });
        if (this.closed) {
            viewer.free();
            return;
        }
        this.viewer = viewer;
        for (const [name, value] of Object.entries(settings)) {
            try {
                viewer.set(name, String(value));
            } catch (error) {
                this.say(error.message);
            }
        }
        viewer.settle();
        this.redraw();
    }

    redraw() {
        if (this.request === 0 && this.viewer !== null && document.visibilityState !== 'hidden') {
            this.request = requestAnimationFrame(() => this.frame());
        }
    }

    redrawSoon() {
        clearTimeout(this.timer);
        this.timer = setTimeout(() => this.redraw(), SOON_MS);
    }

    frame() {
        this.request = 0;
        const { viewer } = this;
        if (viewer === null) {
            return;
        }
        const { FrameState } = this.module.exports;
        const { width, height } = this.size.now();
        let state;
        try {
            state = viewer.frame(performance.now(), width, height);
        } catch (error) {
            this.broken(error);
            return;
        }
        this.frames += 1;
        if (state === FrameState.Moving) {
            this.redraw();
        } else if (state !== FrameState.Still) {
            this.redrawSoon();
        }
        viewer.takeMessages().forEach((text) => this.say(text));
        this.options.drawn?.();
        if (viewer.wantsSky || viewer.wantsStars) {
            // After this frame is shown.
            setTimeout(() => this.viewer === viewer && this.makeWhatIsWanted());
        }
    }

    /** Starts what the picture lacks: the whole sky, and the stars. */
    makeWhatIsWanted() {
        const { viewer } = this;
        const name = viewer.takeWantedSky();
        if (name !== undefined) {
            this.skies.make(name, viewer, () => this.viewer === viewer && this.redraw());
        }
        if (viewer.wantsStars && viewer.drawsStars) {
            this.skies.fetchStars(viewer, () => this.viewer === viewer && this.redraw());
        } else if (viewer.wantsStars && !this.toldStars) {
            this.toldStars = true;
            this.say('Stars as points need WebGPU, which this browser does not offer here.');
        }
    }

    hiddenOrShown() {
        if (document.visibilityState === 'hidden') {
            cancelAnimationFrame(this.request);
            clearTimeout(this.timer);
            this.request = 0;
            this.viewer?.pause(performance.now());
        } else {
            this.redraw();
        }
    }

    /** The settings that differ from the defaults; those of the last viewer while there is none. */
    settings() {
        if (this.viewer === null) {
            return this.last;
        }
        const changed = this.viewer.changedSettings();
        const settings = {};
        for (let i = 0; i < changed.length; i += 2) {
            settings[changed[i]] = changed[i + 1];
        }
        this.last = settings;
        return settings;
    }

    contextLost(event) {
        // Without this the browser does not restore the context.
        event.preventDefault();
        if (this.viewer?.backend === 'webgl') {
            const restored = new Promise((done, failed) => {
                this.canvas.addEventListener('webglcontextrestored', done, { once: true });
                setTimeout(() => failed(new Error('the browser does not give it back')), RESTORE_MS);
            });
            this.lost('the WebGL context was lost', restored);
        }
    }

    /** Opens another viewer in place of one whose device is lost, once `ready`. */
    async lost(reason, ready = Promise.resolve()) {
        if (this.closed || this.viewer === null) {
            return;
        }
        const settings = this.settings();
        this.close();
        const now = performance.now();
        this.losses = this.losses.filter((time) => now - time < RECOVERY_MS);
        this.losses.push(now);
        if (this.losses.length > RECOVERIES) {
            this.options.failed?.(`${reason}, again and again. Reload the page to try once more.`);
            return;
        }
        this.say('The graphics device was lost; drawing again.');
        try {
            await ready;
            await this.openViewer(settings);
            if (this.file !== null) {
                await this.openFile(this.file);
            }
        } catch (error) {
            this.options.failed?.(`${reason}, and cannot be opened again: ${error.message ?? error}`);
        }
    }

    /** A frame failed: a lost device if the viewer can still speak, else an error in it. */
    broken(error) {
        if (error instanceof WebAssembly.RuntimeError) {
            this.viewer = null;
            this.options.failed?.('The viewer failed: reload the page. The console says more.');
            console.error(error);
        } else {
            this.lost(error.message ?? String(error));
        }
    }

    async openFile(file) {
        if (file.size > MOST_BYTES) {
            throw new Error(`${file.name}: larger than ${MOST_BYTES / 1024 / 1024} MiB`);
        }
        const bytes = new Uint8Array(await file.arrayBuffer());
        const { viewer } = this;
        if (viewer === null) {
            throw new Error(`${file.name}: nothing is drawn now`);
        }
        if (!viewer.takeTable(file.name, bytes)) {
            this.say(`reading ${file.name} …`);
            await this.skies.read(file.name, bytes, viewer, () => this.viewer === viewer && this.redraw());
        }
        this.file = file;
        this.redraw();
    }

    async screenshot() {
        if (this.viewer === null) {
            throw new Error('nothing is drawn now');
        }
        const { width, height } = this.size.now();
        const png = await this.viewer.screenshot(width, height);
        this.redraw();
        return new Blob([png], { type: 'image/png' });
    }

    /** Frees everything, for good. */
    end() {
        this.closed = true;
        this.stop.forEach((stop) => stop());
        this.stop = [];
        this.close();
    }

    async time(count) {
        const { width, height } = this.size.now();
        await this.viewer.drawPictures(width, height, 1);
        const began = performance.now();
        await this.viewer.drawPictures(width, height, count);
        return (performance.now() - began) / count;
    }

    /** Frees the viewer. */
    close() {
        cancelAnimationFrame(this.request);
        clearTimeout(this.timer);
        this.request = 0;
        this.skies.cancel();
        const { viewer } = this;
        this.viewer = null;
        try {
            viewer?.free();
        } catch {
            // A lost device may refuse.
        }
    }

    handle() {
        const view = this;
        const changing = (change) => (...values) => {
            if (this.viewer !== null) {
                change(...values);
                this.redraw();
            }
        };
        return {
            /** Sets a setting, or several as an object. A value that cannot be drawn is told in a message. Throws if there is no such setting, or it has no such value. */
            set: changing((name, value) => {
                const all = typeof name === 'object' ? Object.entries(name) : [[name, value]];
                try {
                    all.forEach(([one, of]) => this.viewer.set(one, String(of)));
                } finally {
                    this.viewer.settle();
                }
            }),
            /** The value of a setting as a text, or undefined. */
            get: (name) => this.viewer?.get(name),
            /** The settings that differ from the defaults, as an object. */
            settings: () => this.settings(),
            /** What a panel shows. */
            panel: () => (this.viewer === null ? null : JSON.parse(this.viewer.panel())),
            reset: changing(() => this.viewer.reset()),
            letGo: changing(() => this.viewer.letGo()),
            backToLetGo: changing(() => this.viewer.backToLetGo()),
            stopMoving: changing(() => this.viewer.stopMoving()),
            /** Shows a file: a panorama or a bending table. */
            openFile: (file) => this.openFile(file),
            /** The picture as a PNG: a promise of a Blob. */
            screenshot: () => this.screenshot(),
            /** Draws the picture `count` times without showing it: a promise of the time of each, ms. */
            time: (count) => this.time(count),
            /** Draws a frame, even if nothing changed. */
            redraw: () => this.redraw(),
            get backend() {
                return view.viewer?.backend;
            },
            get adapter() {
                return view.viewer?.adapter;
            },
            /** Number of frames drawn. */
            get frames() {
                return view.frames;
            },
            /** Whether stars can be drawn as points. */
            get drawsStars() {
                return view.viewer?.drawsStars ?? false;
            },
            /** Whether the whole sky is drawn, not the first coarse one, and nothing else is being loaded. */
            get complete() {
                return view.viewer !== null && !view.viewer.wantsSky && !view.skies.busy;
            },
            /** Frees everything. The canvas keeps its last picture. */
            destroy: () => this.end(),
        };
    }
}
