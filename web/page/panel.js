// The panel: a form whose controls are named after the settings that they show and set.

import { DiscRows } from './disc.js';
import { along, partOf, rangeOf } from './slider.js';

/** Shortest time between two updates while the view moves, ms. */
const UPDATE_MS = 100;
const SMALL = '(max-width: 600px), (max-height: 480px)';

export class Panel {
    constructor(view, form, button, canvas, say) {
        this.say = say;
        this.view = view;
        this.form = form;
        this.button = button;
        this.canvas = canvas;
        this.updated = -Infinity;
        this.timer = 0;
        this.radii = [1, 2];
        this.find = (id) => form.querySelector(`#${id}`);
        this.disc = new DiscRows(form, (text) => this.set('disc', text));
        form.addEventListener('submit', (event) => event.preventDefault());
        form.addEventListener('input', (event) => this.input(event.target));
        form.addEventListener('change', (event) => this.change(event.target));
        // A number that was refused gives way to the one that holds.
        form.addEventListener('focusout', () => setTimeout(() => this.refresh()));
        // A control that was used by the pointer gives the keys back to the view.
        form.addEventListener('pointerup', () => setTimeout(() => this.release()));
        this.find('let-go').addEventListener('click', () => view.letGo());
        this.find('back').addEventListener('click', () => view.backToLetGo());
        this.find('reset').addEventListener('click', () => view.reset());
        button.addEventListener('click', () => this.show(this.form.hidden));
    }

    /** Shows or hides the panel. On a small screen it first stays closed. */
    show(shown) {
        if (!this.begun) {
            this.begun = true;
            this.button.hidden = false;
            shown &&= !matchMedia(SMALL).matches;
        }
        this.form.hidden = !shown;
        this.button.setAttribute('aria-expanded', String(shown));
        this.button.textContent = shown ? 'Close' : 'Settings';
        this.refresh();
    }

    release() {
        const { activeElement } = document;
        const slider = activeElement?.matches?.('input[type="range"], input[type="checkbox"], button');
        if (slider && this.form.contains(activeElement)) {
            activeElement.blur();
        }
    }

    /** Controls that take effect while they are moved. */
    input(control) {
        const { setting, log } = control.dataset;
        if (control.id === 'radius') {
            this.set('radius', along(this.radii, control.value));
        } else if (control.type === 'range' && setting !== undefined) {
            this.set(setting, log === undefined ? control.value : along(rangeOf(control), control.value));
        }
    }

    /** Controls that take effect when they are complete. */
    change(control) {
        if (control.dataset.number !== undefined) {
            this.set(control.dataset.number, control.value);
        } else if (control.type === 'checkbox') {
            this.set(control.dataset.setting, control.checked ? 'on' : 'off');
        } else if (control.matches('select')) {
            this.set(control.dataset.setting, control.value);
        }
    }

    set(name, value) {
        try {
            this.view.set(name, value);
        } catch (error) {
            this.say(error.message);
            this.refresh();
        }
    }

    /** Shows the settings after a frame, but not at every frame while the view moves. */
    update() {
        const left = this.updated + UPDATE_MS - performance.now();
        if (left <= 0) {
            this.refresh();
        } else if (this.timer === 0) {
            this.timer = setTimeout(() => this.refresh(), left);
        }
    }

    refresh() {
        clearTimeout(this.timer);
        this.timer = 0;
        this.updated = performance.now();
        const now = this.view.panel();
        if (now === null) {
            return;
        }
        if (now.title !== undefined) {
            document.title = now.title;
            // A screen reader would speak all the time.
            if (!now.moves) {
                this.canvas.setAttribute('aria-label', `The sky around a black hole: ${now.title}`);
            }
        }
        if (this.form.hidden) {
            return;
        }
        this.choices(now);
        this.values(now);
        this.rows(now);
        list(this.find('facts'), now.facts);
        list(this.find('costs'), [['drawn by', `${this.view.adapter}`], ...(now.costs ?? [])]);
        this.find('region').textContent = now.heldRadius ?? now.region;
        this.find('let-go').textContent = `${now.letGo} (G)`;
        this.find('back').hidden = now.back === null;
        this.find('back').textContent = `${now.back} (T)`;
    }

    choices(now) {
        const motions = now.motions.map(({ value, name, problem }) => ({ value, name, problem }));
        options(this.find('motion'), motions);
        options(this.find('sky'), (now.skies ?? []).map((name) => ({ value: name, name, problem: null })));
    }

    values(now) {
        const all = { ...now.values, sky: now.sky, stars: this.view.get('stars') };
        for (const control of this.form.querySelectorAll('[data-setting]')) {
            const value = all[control.dataset.setting];
            if (control.type === 'checkbox') {
                control.checked = value !== 'off';
            } else if (control.dataset.log !== undefined) {
                control.value = partOf(rangeOf(control), value);
                control.setAttribute('aria-valuetext', value);
            } else if (value !== undefined && control !== document.activeElement) {
                control.value = value;
            } else if (control.matches('select')) {
                control.value = value;
            }
        }
        this.radii = now.radii;
        const radius = this.find('radius');
        radius.disabled = now.heldRadius !== null && now.heldRadius !== undefined;
        radius.value = partOf(now.radii, now.values.radius);
        radius.setAttribute('aria-valuetext', `${now.radius} Schwarzschild radii`);
        for (const field of this.form.querySelectorAll('[data-number]')) {
            if (field !== document.activeElement) {
                const value = now.values[field.dataset.number];
                field.value = field.dataset.number === 'radius' ? now.radius : Number(Number(value).toFixed(2));
            }
        }
        for (const output of this.form.querySelectorAll('[data-value]')) {
            const value = Number(all[output.dataset.value]);
            output.textContent = `${Number(value.toFixed(1))}${output.dataset.unit ?? '°'}`;
        }
        this.disc.show(now.disc);
        const stars = this.find('stars');
        stars.disabled = !this.view.drawsStars;
        stars.title = this.view.drawsStars ? '' : 'Stars as points need WebGPU, which this browser does not offer here.';
    }

    /** Shows the rows that have an effect with these settings. */
    rows(now) {
        const { motion, method, resolution, shift } = now.values;
        for (const row of this.form.querySelectorAll('.row')) {
            const { motion: motions, method: methods, resolution: resolutions, if: flag } = row.dataset;
            const shown =
                (motions === undefined || motions.split(' ').includes(motion)) &&
                (methods === undefined || methods === method) &&
                (resolutions === undefined || resolutions === resolution) &&
                (flag === undefined || now[flag]) &&
                (row.dataset.shift === undefined || shift !== 'off');
            row.hidden = !shown;
        }
    }
}

/** Fills a list of names and values, changing only what differs. */
function list(element, rows) {
    while (element.children.length > 2 * rows.length) {
        element.lastChild.remove();
    }
    while (element.children.length < 2 * rows.length) {
        element.append(document.createElement('dt'), document.createElement('dd'));
    }
    rows.flat().forEach((text, i) => {
        if (element.children[i].textContent !== text) {
            element.children[i].textContent = text;
        }
    });
}

/** Fills a choice, unless it has these options. */
function options(select, wanted) {
    const key = JSON.stringify(wanted);
    if (select.dataset.key === key) {
        return;
    }
    select.dataset.key = key;
    select.replaceChildren(
        ...wanted.map(({ value, name, problem }) => {
            const option = new Option(problem === null ? name : `${name} (${problem})`, value);
            option.disabled = problem !== null;
            return option;
        }),
    );
}
