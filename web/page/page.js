// The page: a view that fills it, with the panel, the address, files, full screen and messages around it.

import { readAddress, AddressBar } from './address.js';
import { createLensbake } from './lensbake.js';
import { loadModule } from './module.js';
import { Messages } from './messages.js';
import { Panel } from './panel.js';

/** Time for which the button that hides everything leaves its message, ms. */
const HIDE_MS = 2500;

const element = (id) => document.getElementById(id);
const canvas = element('view');
const messages = new Messages(element('message'));
const address = readAddress(location.search);
let view = null;
let panel = null;
let bar = null;
let pictures = 0;
let drawn = false;

function progress(loaded, total) {
    const mb = (bytes) => (bytes / 1e6).toFixed(1);
    const part = element('loading-bar');
    part.hidden = false;
    if (total > 0) {
        part.max = total;
        part.value = loaded;
    } else {
        part.removeAttribute('value');
    }
    element('loading-text').textContent =
        total > 0 ? `loading ${mb(loaded)} of ${mb(total)} MB` : `loading ${mb(loaded)} MB`;
}

/** Says why nothing can be drawn, with a still picture. */
function fail(text) {
    element('loading').hidden = true;
    element('panel').hidden = true;
    element('panel-button').hidden = true;
    element('failure-text').textContent = text;
    element('still').src = 'still.jpg';
    element('still').hidden = false;
    element('failure').hidden = false;
}

function command(name) {
    const does = {
        'full-screen': toggleFullScreen,
        screenshot,
        'save-path': savePath,
        leave: () => document.fullscreenElement && document.exitFullscreen(),
    };
    does[name]?.();
}

function toggleFullScreen() {
    if (!document.fullscreenEnabled) {
        messages.say('This browser has no full screen for pages.');
        return;
    }
    const shown = document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen();
    shown.catch((error) => messages.say(`No full screen: ${error.message}`));
}

/** Saves a blob as a download of this name. */
function save(blob, name) {
    const url = URL.createObjectURL(blob);
    const link = document.createElement('a');
    link.href = url;
    link.download = name;
    link.click();
    messages.say(`saved ${name}`);
    setTimeout(() => URL.revokeObjectURL(url), 60000);
}

function savePath() {
    const path = view.path();
    if (path === undefined) {
        messages.say('there is no path to save: K sets a keyframe');
    } else {
        save(new Blob([path], { type: 'application/json' }), 'lensbake-path.json');
    }
}

async function screenshot() {
    try {
        const picture = await view.screenshot();
        pictures += 1;
        save(picture, `lensbake-${pictures}.png`);
    } catch (error) {
        messages.say(`No picture: ${error.message}`);
    }
}

function openFile(file) {
    view.openFile(file).catch((error) => messages.say(error.message));
}

/** Keys that the page answers instead of the view: H hides everything, ? and F1 show the help. */
function pageKeys(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest('input, select, textarea')) {
        return;
    }
    if (element('help').open) {
        return;
    }
    if (event.code === 'KeyH' && !event.repeat) {
        hideAll(!document.body.classList.contains('bare'));
    } else if (event.key === '?' || event.code === 'F1') {
        element('help').showModal();
    } else if (event.code === 'Escape' && document.body.classList.contains('bare')) {
        hideAll(false);
    } else {
        return;
    }
    event.preventDefault();
}

function hideAll(hidden) {
    document.body.classList.toggle('bare', hidden);
    if (!hidden) {
        panel.update();
    }
}

/** Rows of the help: the keys of the viewer, as far as they do the same on a page. */
async function fillHelp() {
    const { exports } = await loadModule(() => {});
    const bindings = exports.Viewer.keyBindings();
    const other = {
        'P, F12': ['P', 'save the picture'],
        'H, F1': ['H', 'hide and show everything else'],
        'Esc': ['Esc', 'leave full screen or the help'],
        'Tab': ['Tab', 'go to the next control'],
        'drop a file': ['drop a file', 'a panorama or a bending table, which is sent nowhere'],
    };
    const rows = [];
    for (let i = 0; i < bindings.length; i += 2) {
        rows.push(other[bindings[i]] ?? [bindings[i], bindings[i + 1]]);
    }
    rows.push(['?, F1', 'this help'], ['two fingers', 'go round the hole'], ['pinch', 'nearer, farther']);
    for (const [names, does] of rows) {
        const row = element('keys').insertRow();
        const head = document.createElement('th');
        head.scope = 'row';
        head.textContent = names;
        row.append(head);
        row.insertCell().textContent = does;
    }
}

function listenToPage() {
    window.addEventListener('keydown', pageKeys, { capture: true });
    element('screenshot').addEventListener('click', screenshot);
    element('full-screen').addEventListener('click', toggleFullScreen);
    // An iPhone has no full screen.
    element('full-screen').hidden = !document.fullscreenEnabled;
    element('help-button').addEventListener('click', () => element('help').showModal());
    element('hide').addEventListener('click', () => {
        messages.say('H or a tap shows everything again.');
        setTimeout(() => hideAll(true), HIDE_MS);
    });
    canvas.addEventListener('pointerdown', (event) => {
        if (document.body.classList.contains('bare') && event.pointerType === 'touch') {
            hideAll(false);
        }
    });
    element('file').addEventListener('change', (event) => {
        const [file] = event.target.files;
        if (file !== undefined) {
            openFile(file);
        }
        // So that the same file can be chosen again.
        event.target.value = '';
    });
    const dropping = (on) => document.body.classList.toggle('dropping', on);
    window.addEventListener('dragover', (event) => {
        event.preventDefault();
        dropping(true);
    });
    window.addEventListener('dragleave', (event) => event.relatedTarget === null && dropping(false));
    window.addEventListener('drop', (event) => {
        event.preventDefault();
        dropping(false);
        const [file] = event.dataTransfer.files;
        if (file !== undefined) {
            openFile(file);
        }
    });
}

/** What the address asks to move stays still where the system asks for less motion, until the user moves it. */
function respectReducedMotion() {
    if (matchMedia('(prefers-reduced-motion: reduce)').matches && view.panel().moves) {
        view.stopMoving();
        messages.say('The view does not move by itself, because the system asks for less motion. R or G moves it.');
    }
}

async function start() {
    view = await createLensbake(canvas, {
        settings: address.settings,
        backend: address.ofPage.backend,
        pass: address.ofPage.pass,
        keys: window,
        message: (text) => messages.say(text),
        command,
        drawn: () => {
            if (!drawn) {
                drawn = true;
                performance.mark('first-picture');
            }
            panel?.update();
            bar?.changed();
        },
        failed: fail,
    });
    address.problems.forEach((text) => messages.say(text));
    bar = new AddressBar(view, address.ofPage);
    panel = new Panel(view, element('panel'), element('panel-button'), canvas, (text) => messages.say(text));
    listenToPage();
    await fillHelp();
    respectReducedMotion();
    element('loading').hidden = true;
    panel.show(address.ofPage.panel !== 'off');
    // For tests and the curious: the same functions as on any page.
    window.lensbake = view;
}

async function begin() {
    try {
        element('loading-text').textContent = 'loading';
        await loadModule(progress);
    } catch (error) {
        console.warn(error);
        const needs = 'WebAssembly' in window ? 'Reload the page to try again' : 'This browser has no WebAssembly';
        fail(`The page cannot be loaded (${error.message}). ${needs}.`);
        return;
    }
    try {
        await start();
    } catch (error) {
        console.warn(error);
        fail(`This page needs WebGPU or WebGL 2, and neither draws in this browser (${error.message}).`);
    }
}

begin();
