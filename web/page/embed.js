import { createLensbake } from './lensbake.js';

const element = (id) => document.getElementById(id);
const message = (text) => (element('message').textContent = text);

let show = () => {};
const far = await createLensbake(element('far'), {
    settings: { radius: 25, sky: 'grid' },
    message,
    drawn: () => show(),
});

show = () => (element('far-radius').textContent = Number(far.get('radius')).toFixed(2));

const near = await createLensbake(element('near'), {
    settings: { radius: 1, motion: 'fall', fov: 120, sky: 'grid' },
    message,
});

element('radius').addEventListener('input', (event) => {
    near.set('radius', event.target.value);
    element('near-radius').textContent = event.target.value;
});

element('save').addEventListener('click', async () => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(await far.screenshot());
    link.download = 'hole.png';
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
});

element('end').addEventListener('click', () => near.destroy());

// For tests.
window.views = { far, near };
