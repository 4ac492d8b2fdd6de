// The stored value at the position q, from 0 at the edge of the shadow to 1 straight away from the hole, for the
// observer at rest at r: one fetch from the atlas with linear filtering. The centres of texels are at half-integers.
fn stored_value(q: f32, RADIUS, DATA) -> f32 {
    let row: f32 = LAST_ROW * 0.6366197724 * atan(1.0 / sqrt(max(r - 1.0, 1e-30)));
    let x: f32 = (q * LAST + 0.5) / TEXELS;
    let y: f32 = (row + 0.5) / ROWS;
    return VALUE_SCALE SAMPLED;
}
