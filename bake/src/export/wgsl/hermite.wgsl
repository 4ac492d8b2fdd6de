// The stored value at the position q, from 0 at the edge of the shadow to 1 straight away from the hole.
fn stored_value(q: f32, RADIUS, DATA) -> f32 {
    let position: f32 = q * LAST;
    let i: i32 = i32(min(position, BEFORE_LAST));
    let a: vec2<f32> = texel(i, RADIUS, DATA);
    let b: vec2<f32> = texel(i + 1, RADIUS, DATA);
    let mixed: vec2<f32> = cubic(a, b, position - f32(i));
    return mixed.x;
}
