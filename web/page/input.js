// Passes keys, mouse and touches to a viewer.

/** Pixels of scrolling that count as one notch of a mouse wheel, and of a pinch on a touchpad, which is sent as Ctrl + wheel. */
const PIXELS_A_NOTCH = 100;
const PIXELS_A_PINCH = 10;
/** Most pixels that one event of a pinch has. */
const MOST_OF_A_PINCH = 50;
const LINES_A_NOTCH = 3;

/** Elements that use keys themselves. */
const TYPING = 'input, select, textarea, [contenteditable], dialog';
/** Keys that a page leaves to the browser: they move the focus, and open its tools. */
const LEFT_ALONE = ['Tab', 'F12'];

/** Listens to the canvas and the keys; returns a function that ends it. */
export function listen(canvas, options, view) {
    const ended = new AbortController();
    const on = (target, type, handler, more = {}) => {
        target.addEventListener(type, handler, { signal: ended.signal, ...more });
    };
    const { touchAction } = canvas.style;
    if (options.pointer ?? true) {
        canvas.style.touchAction = 'none';
        pointer(canvas, view, on);
    }
    const keys = options.keys === undefined ? canvas : options.keys;
    if (keys !== null) {
        keyboard(keys, view, on);
    }
    return () => {
        ended.abort();
        canvas.style.touchAction = touchAction;
    };
}

function keyboard(target, view, on) {
    const pressed = (event) => {
        const viewer = view.viewer();
        const typing = event.target instanceof Element && event.target.closest(TYPING) !== null;
        if (viewer === null || event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) {
            return;
        }
        if (LEFT_ALONE.includes(event.code) || (typing && event.code !== 'Escape')) {
            return;
        }
        const does = viewer.key(event.code, event.repeat ? 'repeated' : 'pressed', performance.now());
        if (does === undefined) {
            return;
        }
        if (does === 'redraw' || does === '') {
            event.preventDefault();
            view.changed();
        } else if (view.command(does) && does !== 'leave') {
            // To leave is left to the browser as well, which closes dialogs.
            event.preventDefault();
        }
    };
    // Whatever else is held: a key whose release is missed would move the view for ever.
    const released = (event) => {
        view.viewer()?.key(event.code, 'released', performance.now());
        if (event.key === 'Meta') {
            // macOS tells of no key that is released while Command is held.
            view.viewer()?.pause(performance.now());
        }
        view.changed();
    };
    const left = () => {
        view.viewer()?.pause(performance.now());
        view.changed();
    };
    on(target, 'keydown', pressed);
    on(target, 'keyup', released);
    on(target, 'focusout', left);
    // Nothing loses the focus where the body had it.
    on(target, 'focusin', (event) => {
        if (event.target.closest(TYPING) !== null) {
            left();
        }
    });
    on(window, 'blur', left);
}

/** What counts as one notch in an event of the wheel. */
function notch({ deltaMode, deltaY, ctrlKey }) {
    if (deltaMode !== WheelEvent.DOM_DELTA_PIXEL) {
        return LINES_A_NOTCH;
    }
    return ctrlKey && Math.abs(deltaY) < MOST_OF_A_PINCH ? PIXELS_A_PINCH : PIXELS_A_NOTCH;
}

function pointer(canvas, view, on) {
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
    for (const type of ['pointerup', 'pointercancel', 'lostpointercapture']) {
        on(canvas, type, up);
    }
    on(window, 'blur', () => {
        down.clear();
        view.viewer()?.pointerReleased();
    });
    on(canvas, 'contextmenu', (event) => event.preventDefault());
    on(
        canvas,
        'wheel',
        (event) => {
            event.preventDefault();
            view.viewer()?.wheel(-event.deltaY / notch(event), event.ctrlKey);
            view.changed();
        },
        { passive: false },
    );
}
