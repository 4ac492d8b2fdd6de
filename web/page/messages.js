// Messages at the lower edge, each shown for as long as it takes to read.

const LEAST_MS = 8000;
const MOST_MS = 20000;
const MS_A_CHARACTER = 60;

export class Messages {
    constructor(element) {
        this.element = element;
        this.timer = 0;
    }

    say(text) {
        this.element.textContent = text;
        this.element.hidden = false;
        clearTimeout(this.timer);
        const time = Math.min(Math.max(LEAST_MS, MS_A_CHARACTER * text.length), MOST_MS);
        this.timer = setTimeout(() => (this.element.hidden = true), time);
    }
}
