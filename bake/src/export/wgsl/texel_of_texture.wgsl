// Texel i of the row: the stored value and its slope per texel.
fn texel(i: i32, RADIUS, DATA) -> vec2<f32> {
    let stored: vec2<f32> = LOADED;
    return vec2<f32>(VALUE_SCALE stored.x, SLOPE_SCALE stored.y);
}
