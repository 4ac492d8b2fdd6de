// The size of a canvas in pixels of the screen.

/** Most pixels of a canvas: a screen of 4K. Larger ones are drawn with fewer pixels. */
const MOST_PIXELS = 3840 * 2160;

/**
 * Watches the size of an element whose size its style sets, and calls `changed` when it has other pixels. The size of a
 * canvas in pixels never sets its size on the page, so that it cannot grow by itself.
 */
export function watchSize(element, changed) {
    let exact = null;
    const observer = new ResizeObserver((entries) => {
        const box = entries[0].devicePixelContentBoxSize?.[0];
        exact = box ? { width: box.inlineSize, height: box.blockSize } : null;
        changed();
    });
    try {
        observer.observe(element, { box: 'device-pixel-content-box' });
    } catch {
        observer.observe(element); // Safari
    }
    // Another ratio of pixels, as on another screen, does not change the size on the page.
    let ratio = null;
    const watchRatio = () => {
        ratio?.removeEventListener('change', watchRatio);
        if (ratio !== null) {
            exact = null;
            changed();
        }
        ratio = matchMedia(`(resolution: ${devicePixelRatio}dppx)`);
        ratio.addEventListener('change', watchRatio);
    };
    watchRatio();

    const whole = () => {
        const { width, height } = element.getBoundingClientRect();
        const near = { width: Math.round(width * devicePixelRatio), height: Math.round(height * devicePixelRatio) };
        // Browsers that emulate another ratio do not scale the exact size.
        const agrees = exact !== null && Math.abs(exact.width - near.width) < 2 && Math.abs(exact.height - near.height) < 2;
        return agrees ? exact : near;
    };
    const now = () => {
        const { width, height } = whole();
        const part = Math.min(1, Math.sqrt(MOST_PIXELS / Math.max(1, width * height)));
        return { width: Math.floor(width * part), height: Math.floor(height * part) };
    };
    return {
        now,
        /** Pixels per pixel of the page's style. */
        ratio: () => now().width / Math.max(1, element.getBoundingClientRect().width),
        stop: () => {
            observer.disconnect();
            ratio.removeEventListener('change', watchRatio);
        },
    };
}
