// Texel i of the row: the stored value and its slope per texel.
fn texel(i: i32, RADIUS, DATA) -> vec2<f32> {
    return vec2<f32>(VALUE_SCALE ROW[2 * i], SLOPE_SCALE ROW[2 * i + 1]);
}
