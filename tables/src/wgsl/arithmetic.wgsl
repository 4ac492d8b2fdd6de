// Arithmetic that the lookups share. Each function has a mirror of the same name in Rust: `chord` and `cubic` in
// interpolation.rs, the others in mirror.rs.

// Linear interpolation between the values a.x (at t = 0) and b.x (at t = 1): the value and its derivative at t.
fn chord(a: vec2<f32>, b: vec2<f32>, t: f32) -> vec2<f32> {
    let rise = b.x - a.x;
    return vec2(a.x + t * rise, rise);
}

// Cubic Hermite interpolation between the values a.x and slopes a.y (at t = 0) and the values b.x and slopes b.y
// (at t = 1): the value and its derivative at t.
fn cubic(a: vec2<f32>, b: vec2<f32>, t: f32) -> vec2<f32> {
    let rise: f32 = b.x - a.x;
    let c2: f32 = 3.0 * rise - 2.0 * a.y - b.y;
    let c3: f32 = a.y + b.y - 2.0 * rise;
    return vec2<f32>(a.x + t * (a.y + t * (c2 + t * c3)), a.y + t * (2.0 * c2 + t * 3.0 * c3));
}

// (cos, sin) of an angle in rad, to 1e-7 up to 100 turns. The built-in pair need only be good to
// 5e-4 on a Vulkan device, which is half a pixel.
fn cos_sin(angle: f32) -> vec2<f32> {
    let quarter: f32 = round(angle * 0.63661975);
    // π/2 in three parts, the products of the first two exact: a device need not fuse an fma.
    let r: f32 = ((angle - quarter * 1.5703125) - quarter * 4.837513e-4) - quarter * 7.54979e-8;
    let r2: f32 = r * r;
    let sine: f32 = r + r * r2 * (-1.6666654e-1 + r2 * (8.332161e-3 + r2 * -1.9515296e-4));
    let cosine: f32 = 1.0 - 0.5 * r2 + r2 * r2 * (4.1666646e-2 + r2 * (-1.3887316e-3 + r2 * 2.4433157e-5));
    let turn: i32 = i32(quarter) & 3;
    let swapped: vec2<f32> = select(vec2<f32>(cosine, sine), vec2<f32>(sine, cosine), (turn & 1) == 1);
    return vec2<f32>(
        select(swapped.x, -swapped.x, turn == 1 || turn == 2),
        select(swapped.y, -swapped.y, turn >= 2)
    );
}

// The angle in [0, π] whose cosine and sine have the ratio c : p, with p ≥ 0, to 2e-7. The built-in function is
// only required to be accurate to 4096 ulp.
fn angle(c: f32, p: f32) -> f32 {
    let a = abs(c);
    var base = 0.0;
    var x = p / max(a, 1e-30);
    if p > 2.4142135 * a {
        base = 1.5707964;
        x = -a / p;
    } else if p > 0.41421357 * a {
        base = 0.7853982;
        x = (p - a) / (p + a);
    }
    let z = x * x;
    let first = base + (x + x * z * (-3.3332950e-1 + z * (1.9977711e-1 + z * (-1.3877685e-1 + z * 8.0537446e-2))));
    return select(first, 3.1415927 - first, c < 0.0);
}
