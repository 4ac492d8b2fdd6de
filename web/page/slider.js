// Logarithmic sliders, which go from 0 to 1 along a range of values.

/** The range of a slider, its `data-log`: the values at its ends. */
export const rangeOf = (slider) => slider.dataset.log.split(' ').map(Number);

/** The value at a part of a range, with four digits. */
export function along([least, most], part) {
    const value = least * (most / least) ** part;
    return Math.min(Math.max(Number(value.toPrecision(4)), least), most);
}

/** The part of a range at a value, 0 or 1 beyond its ends. */
export function partOf([least, most], value) {
    const part = Math.log(value / least) / Math.log(most / least);
    return Math.min(Math.max(part, 0), 1);
}
