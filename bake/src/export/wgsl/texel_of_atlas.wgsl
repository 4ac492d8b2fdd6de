// Texel i of the row of the observer at rest at r: the stored value and its slope per texel, mixed from four rows of
// the atlas by Lagrange's cubic. At the ends all four rows are inside the atlas.
fn texel(i: i32, RADIUS, DATA) -> vec2<f32> {
    // The angle with this sine and cosine. One step of Newton's method, because the arc tangent of Open Shading Language may
    // be off by 7e-6.
    let sine: f32 = sqrt(1.0 / r);
    let cosine: f32 = sqrt(max((r - 1.0) / r, 0.0));
    let guess: f32 = atan(sine / max(cosine, 1e-15));
    let angle: f32 = guess + (sine * cos(guess) - cosine * sin(guess));
    let place: f32 = LAST_ROW * 0.6366197724 * angle;
    let first: f32 = min(max(floor(place) - 1.0, 0.0), LAST_ROW - 3.0);
    let t: f32 = place - first;
    let w0: f32 = -(t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0;
    let w1: f32 = t * (t - 2.0) * (t - 3.0) / 2.0;
    let w2: f32 = -t * (t - 1.0) * (t - 3.0) / 2.0;
    let w3: f32 = t * (t - 1.0) * (t - 2.0) / 6.0;
    let a: i32 = 2 * (i32(first) * TEXEL_COUNT + i);
    let b: i32 = a + 2 * TEXEL_COUNT;
    let c: i32 = b + 2 * TEXEL_COUNT;
    let d: i32 = c + 2 * TEXEL_COUNT;
    let value: f32 = w0 * ROW[a] + w1 * ROW[b] + w2 * ROW[c] + w3 * ROW[d];
    let slope: f32 = w0 * ROW[a + 1] + w1 * ROW[b + 1] + w2 * ROW[c + 1] + w3 * ROW[d + 1];
    return vec2<f32>(VALUE_SCALE value, SLOPE_SCALE slope);
}
