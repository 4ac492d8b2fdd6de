// The settings in the address of the page, so that it can be shared and restored.

/** Time after the last change until it is in the address, ms: browsers refuse more than three changes a second. */
const QUIET_MS = 400;
/** Longest time that a moving view keeps its address, ms. */
const MOST_MS = 2000;

/**
 * Names that are the page's own, with their values: what draws, in which passes, and whether the panel is shown.
 */
const OF_PAGE = { backend: ['auto', 'webgpu', 'webgl'], pass: ['auto', 'compute', 'fragment'], panel: ['on', 'off'] };

/**
 * What the query of an address says: `settings` of the view, and those `ofPage`; `problems` says which of these have values
 * that do not exist.
 */
export function readAddress(query) {
    const result = { settings: {}, ofPage: {}, problems: [] };
    for (const [name, value] of new URLSearchParams(query)) {
        if (!Object.hasOwn(OF_PAGE, name)) {
            result.settings[name] = value;
        } else if (OF_PAGE[name].includes(value)) {
            result.ofPage[name] = value;
        } else {
            result.problems.push(`${name} is '${value}', but must be ${OF_PAGE[name].join(', ')}`);
        }
    }
    return result;
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
