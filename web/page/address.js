// The settings in the address of the page, so that it can be shared and restored.

/** Time after the last change until it is in the address, ms: browsers refuse more than three changes a second. */
const QUIET_MS = 400;
/** Longest time that a moving view keeps its address, ms. */
const MOST_MS = 2000;

/**
 * Names that are the page's own: what draws (webgpu, webgl) and in which passes (compute, fragment), and whether the panel
 * is shown (on, off).
 */
const OF_PAGE = ['backend', 'pass', 'panel'];

/** What the query of an address says: `settings` of the view, and those `ofPage`. */
export function readAddress(query) {
    const all = [...new URLSearchParams(query)];
    const isOfPage = ([name]) => OF_PAGE.includes(name);
    return {
        settings: Object.fromEntries(all.filter((one) => !isOfPage(one))),
        ofPage: Object.fromEntries(all.filter(isOfPage)),
    };
}

/** The query of settings; commas and slashes are left readable. */
function query(settings, ofPage) {
    const all = new URLSearchParams({ ...settings, ...ofPage });
    const text = all.toString().replaceAll('%2C', ',').replaceAll('%2F', '/');
    return text === '' ? '' : `?${text}`;
}

export class AddressBar {
    /** `ofPage` are names and values that stay in the address. */
    constructor(view, ofPage) {
        this.view = view;
        this.ofPage = ofPage;
        this.timer = 0;
        this.first = 0;
    }

    /** Writes the settings to the address in a while. */
    changed() {
        const now = performance.now();
        if (this.timer === 0) {
            this.first = now;
        }
        clearTimeout(this.timer);
        const left = Math.max(0, this.first + MOST_MS - now);
        this.timer = setTimeout(() => this.write(), Math.min(QUIET_MS, left));
    }

    write() {
        this.timer = 0;
        const wanted = query(this.view.settings(), this.ofPage);
        if (wanted !== location.search) {
            history.replaceState(null, '', `${location.pathname}${wanted}${location.hash}`);
        }
    }
}
