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
/** Times between attempts to open it, ms: a browser may need a moment to start its GPU process again. */
const RETRIES_MS = [500, 2000, 5000];
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
 * - `command(name)`: called for the keys that a page answers: 'full-screen', 'screenshot', 'save-path', 'leave';
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

/** How a table begins: as a binary file, or as OpenEXR, which a picture may be as well. */
const TABLES = [[...'LENSBAKE'].map((letter) => letter.charCodeAt(0)), [0x76, 0x2f, 0x31, 0x01]];

const mayBeTable = (bytes) => TABLES.some((start) => start.every((byte, i) => bytes[i] === byte));

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
        this.backend = options.backend ?? 'auto';
        this.requested = 0;
        /** Files of the user's own that are shown: a sky and a table. */
        this.own = { sky: null, table: null };
        this.ended = new AbortController();
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
                /** Passes a command to the page; false if the page answers none. */
                command: (name) => {
                    this.options.command?.(name);
                    return this.options.command !== undefined;
                },
            }),
        );
    }

    /** Opens a viewer with these settings; what is wrong with them is said, and the others hold. */
    async openViewer(settings) {
        const { Viewer } = this.module.exports;
        const sky = Viewer.builtInSkies().includes(settings.sky) ? settings.sky : 'nebula';
        const { width, height } = this.size.now();
        const pass = this.options.pass ?? 'auto';
        let viewer = null;
        let early = null;
        const failed = (reason) => {
            if (viewer === null) {
                early = reason;
            } else if (this.viewer === viewer) {
                this.lost(reason);
            }
        };
        viewer = await Viewer.open(this.canvas, this.backend, pass, sky, width, height, failed);
        if (this.closed) {
            viewer.free();
            return;
        }
        this.viewer = viewer;
        this.starsBegun = false;
        // A canvas belongs to the kind of context that it had first.
        this.backend = viewer.backend;
        for (const [name, value] of Object.entries(settings)) {
            try {
                viewer.set(name, String(value));
            } catch (error) {
                this.say(error.message);
            }
        }
        viewer.settle();
        this.redraw();
        if (early !== null || this.contextIsLost()) {
            this.lost(early ?? 'the WebGL context was lost');
        }
    }

    redraw() {
        if (this.request === 0 && this.viewer !== null && document.visibilityState !== 'hidden') {
            this.requested = performance.now();
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
        if (width === 0 || height === 0) {
            // Another frame comes with another size.
            return;
        }
        let state;
        try {
            state = viewer.frame(performance.now(), this.requested, width, height);
        } catch (error) {
            this.broken(error);
            return;
        }
        if (state === FrameState.Moving) {
            this.redraw();
        } else if (state !== FrameState.Still) {
            this.redrawSoon();
        }
        viewer.takeMessages().forEach((text) => this.say(text));
        if (state !== FrameState.NotShown) {
            this.frames += 1;
            this.options.drawn?.();
        }
        // What is called may have ended the view.
        if (this.viewer === viewer && (viewer.wantsSky || (viewer.wantsStars && !this.starsBegun))) {
            // After this frame is shown.
            setTimeout(() => this.viewer === viewer && this.makeWhatIsWanted());
        }
    }

    /** Starts what the picture lacks: the whole sky, and the stars. */
    makeWhatIsWanted() {
        const { viewer } = this;
        for (let name = viewer.takeWantedSky(); name !== undefined; name = viewer.takeWantedSky()) {
            this.skies.make(name, viewer, () => this.viewer === viewer && this.redraw());
        }
        if (!viewer.wantsStars || this.starsBegun) {
            return;
        }
        this.starsBegun = true;
        if (viewer.drawsStars) {
            this.skies.fetchStars(viewer, () => this.viewer === viewer && this.redraw());
        } else {
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
            this.lost('the WebGL context was lost');
        }
    }

    /** Whether the canvas draws with WebGL, and its context is lost. */
    contextIsLost() {
        return this.backend === 'webgl' && (this.canvas.getContext('webgl2')?.isContextLost() ?? false);
    }

    /** Opens another viewer in place of one whose device is lost. */
    async lost(reason) {
        if (this.closed || this.viewer === null) {
            return;
        }
        let settings = this.last;
        let sky;
        let path;
        try {
            settings = this.settings();
            sky = this.viewer.get('sky');
            path = this.viewer.path;
        } catch {
            // After an error in it, the viewer says nothing more.
        }
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
            await this.reopen(settings);
        } catch (error) {
            if (!this.closed) {
                this.options.failed?.(`${reason}, and cannot be opened again: ${error.message ?? error}`);
            }
            return;
        }
        if (path !== undefined) {
            this.viewer?.keepPath(path);
        }
        const { own } = this;
        const files = [own.table, own.sky?.name === sky ? own.sky : null].filter((file) => file !== null);
        for (const file of files) {
            await this.openFile(file).catch((error) => this.say(error.message));
        }
    }

    async reopen(settings) {
        for (const wait of [0, ...RETRIES_MS]) {
            await new Promise((done) => setTimeout(done, wait));
            if (this.contextIsLost()) {
                const { signal } = this.ended;
                await new Promise((done) => {
                    this.canvas.addEventListener('webglcontextrestored', done, { once: true, signal });
                });
            }
            if (this.closed) {
                return;
            }
            try {
                await this.openViewer(settings);
                return;
            } catch (error) {
                if (wait === RETRIES_MS.at(-1) || this.closed) {
                    throw error;
                }
            }
        }
    }

    /** A frame failed: the device is lost, or there is an error in the viewer. */
    broken(error) {
        if (error instanceof WebAssembly.RuntimeError) {
            this.viewer = null;
            this.skies.cancel();
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
        if (file.name.toLowerCase().endsWith('.json')) {
            viewer.takePath(file.name, new TextDecoder().decode(bytes));
            this.redraw();
            return;
        }
        if (mayBeTable(bytes) && viewer.takeTable(file.name, bytes)) {
            this.own.table = file;
            this.redraw();
            return;
        }
        this.say(`reading ${file.name} …`);
        const before = this.own.sky;
        // If the device is lost meanwhile, the file is read again.
        this.own.sky = file;
        try {
            await this.skies.read(file.name, bytes, viewer, () => this.redraw());
        } catch (error) {
            if (this.viewer === viewer) {
                this.own.sky = before;
                throw error;
            }
        }
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
        this.ended.abort();
        this.stop.forEach((stop) => stop());
        this.stop = [];
        this.close();
    }

    async time(count) {
        if (this.viewer === null) {
            throw new Error('nothing is drawn now');
        }
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
            /** Shows a file: a panorama or a bending table; a path of the camera (.json) is played. */
            openFile: (file) => this.openFile(file),
            /** The picture as a PNG: a promise of a Blob. */
            screenshot: () => this.screenshot(),
            /** The path of the camera as JSON, as `viewer film` takes it; undefined before the first keyframe. */
            path: () => this.viewer?.path,
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
            /** Ends the view and frees what it holds. What the canvas shows after that depends on the browser. */
            destroy: () => this.end(),
        };
    }
}
