// Passes keys, mouse and touches to a viewer.

/** Pixels of scrolling that count as one notch of a mouse wheel. */
const PIXELS_A_NOTCH = 100;
const LINES_A_NOTCH = 3;

/** Elements that use keys themselves. */
const TYPING = 'input, select, textarea, [contenteditable], dialog';
/** Keys that move the focus, which a page leaves to the browser. */
const LEFT_ALONE = ['Tab'];

/** Listens to the canvas and the keys; returns a function that ends it. */
export function listen(canvas, options, view) {
    const ended = new AbortController();
    const on = (target, type, handler, more = {}) => {
        target.addEventListener(type, handler, { signal: ended.signal, ...more });
    };
    if (options.pointer ?? true) {
        pointer(canvas, view, on);
    }
    const keys = options.keys === undefined ? canvas : options.keys;
    if (keys !== null) {
        keyboard(keys, view, on);
    }
    return () => ended.abort();
}

function keyboard(target, view, on) {
    const pass = (event, change) => {
        const viewer = view.viewer();
        const typing = event.target instanceof Element && event.target.closest(TYPING) !== null;
        if (viewer === null || event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) {
            return;
        }
        if (LEFT_ALONE.includes(event.code) || (typing && change !== 'released' && event.code !== 'Escape')) {
            return;
        }
        const does = viewer.key(event.code, change, performance.now());
        if (does === undefined) {
            return;
        }
        // To leave is left to the browser as well, which closes dialogs.
        if (does !== 'leave') {
            event.preventDefault();
        }
        if (does === 'redraw') {
            view.changed();
        } else if (does !== '') {
            view.command(does);
        }
    };
    on(target, 'keydown', (event) => pass(event, event.repeat ? 'repeated' : 'pressed'));
    on(target, 'keyup', (event) => pass(event, 'released'));
    on(window, 'blur', () => {
        view.viewer()?.pause(performance.now());
        view.changed();
    });
}

function pointer(canvas, view, on) {
    canvas.style.touchAction = 'none';
    const down = new Map();

    const place = (event) => {
        const box = canvas.getBoundingClientRect();
        const ratio = view.ratio();
        return { x: (event.clientX - box.left) * ratio, y: (event.clientY - box.top) * ratio };
    };
    /** The middle of all touches, and how far the first two are apart. */
    const middle = () => {
        const all = [...down.values()];
        const sum = all.reduce((a, b) => ({ x: a.x + b.x, y: a.y + b.y }));
        const [a, b] = all;
        const apart = b === undefined ? 0 : Math.hypot(a.x - b.x, a.y - b.y);
        return { x: sum.x / all.length, y: sum.y / all.length, apart };
    };
    let apart = 0;
    /** Starts a drag with the touches that are down now. */
    const begin = (orbits) => {
        const viewer = view.viewer();
        viewer?.pointerReleased();
        if (viewer !== null && down.size > 0) {
            const at = middle();
            apart = at.apart;
            viewer.pointerAt(at.x, at.y);
            viewer.pointerPressed(orbits || down.size > 1);
        }
    };

    on(canvas, 'pointerdown', (event) => {
        if (event.pointerType === 'mouse' && event.button === 1) {
            return;
        }
        canvas.setPointerCapture(event.pointerId);
        down.set(event.pointerId, place(event));
        begin(event.button === 2);
    });
    on(canvas, 'pointermove', (event) => {
        const viewer = view.viewer();
        if (viewer === null || !down.has(event.pointerId)) {
            return;
        }
        down.set(event.pointerId, place(event));
        const at = middle();
        let changed = viewer.pointerMoved(at.x, at.y);
        if (apart > 0 && at.apart > 0) {
            viewer.pinch(at.apart / apart);
            changed = true;
        }
        apart = at.apart;
        if (changed) {
            view.changed();
        }
    });
    const up = (event) => {
        if (down.delete(event.pointerId)) {
            begin(false);
        }
    };
    on(canvas, 'pointerup', up);
    on(canvas, 'pointercancel', up);
    on(canvas, 'contextmenu', (event) => event.preventDefault());
    on(
        canvas,
        'wheel',
        (event) => {
            event.preventDefault();
            const notch = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? PIXELS_A_NOTCH : LINES_A_NOTCH;
            view.viewer()?.wheel(-event.deltaY / notch, event.ctrlKey);
            view.changed();
        },
        { passive: false },
    );
}
