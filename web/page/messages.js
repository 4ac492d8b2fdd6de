// Messages at the lower edge, each shown for as long as it takes to read.

const LEAST_MS = 8000;
const MOST_MS = 20000;
const MS_A_CHARACTER = 60;
/** Messages that come within this time are shown together, ms. */
const TOGETHER_MS = 1000;

export class Messages {
    constructor(element) {
        this.element = element;
        this.timer = 0;
        this.said = -Infinity;
    }

    say(text) {
        const now = performance.now();
        const { element } = this;
        const before = now - this.said < TOGETHER_MS ? element.textContent.split('\n') : [];
        const all = [...before.filter((one) => one !== text && one !== ''), text].join('\n');
        this.said = now;
        element.textContent = all;
        clearTimeout(this.timer);
        const time = Math.min(Math.max(LEAST_MS, MS_A_CHARACTER * all.length), MOST_MS);
        // The element stays, empty, because screen readers tell only of changes in what is there.
        this.timer = setTimeout(() => (element.textContent = ''), time);
    }
}
