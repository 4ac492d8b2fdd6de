// The radii of the disc in the panel: one setting, with a slider and a field for each radius.

import { along, partOf, rangeOf } from './slider.js';

export class DiscRows {
    /** `set` is called with the inner and the outer radius, as a text, when the user changes one. */
    constructor(form, set) {
        this.set = set;
        this.disc = null;
        this.seenFrom = form.querySelector('#disc-seen-from');
        this.seenHere = form.querySelector('#disc-seen-here');
        this.sliders = ['inner', 'outer'].map((name) => form.querySelector(`#disc-${name}`));
        this.fields = ['inner', 'outer'].map((name) => form.querySelector(`#disc-${name}-number`));
        this.sliders.forEach((slider, i) => slider.addEventListener('input', () => this.slide(i)));
        this.fields.forEach((field, i) => field.addEventListener('change', () => this.change(i, field.value)));
    }

    /** A slider stops before the other radius. */
    slide(i) {
        const slider = this.sliders[i];
        const [least, most] = this.disc.stops[i];
        const radius = along(rangeOf(slider), slider.value);
        this.change(i, Math.min(Math.max(radius, least), most));
    }

    change(i, radius) {
        const radii = [...this.disc.radii];
        radii[i] = radius;
        this.set(radii.join(','));
    }

    /** Shows a disc, as `panel()` of a view has it; null if there is none. */
    show(disc) {
        this.disc = disc;
        this.seenFrom.textContent = disc?.seenFrom ?? '';
        this.seenHere.textContent = disc?.seenHere ?? '';
        disc?.radii.forEach((radius, i) => {
            const text = `${Number(radius.toFixed(2))}`;
            this.sliders[i].value = partOf(rangeOf(this.sliders[i]), radius);
            this.sliders[i].setAttribute('aria-valuetext', `${text} Schwarzschild radii`);
            if (this.fields[i] !== document.activeElement) {
                this.fields[i].value = text;
            }
        });
    }
}
