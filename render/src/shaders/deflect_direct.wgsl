// Deflection by direct integration with RK4: the textbook method, forward along the ray from the observer, in f32.
// It uses neither the table nor the shadow's edge. The module `step` defines `const STEP: f32`, the step of
// orbital angle in rad. It is a constant because a driver may compile a shader again for every value of a uniform
// that a loop depends on.
// #import arithmetic
// #import camera
// #import deflection
// #import start
// #import step

// Largest orbital angle that is integrated, rad. In f32 no ray that turns further can be distinguished from a
// captured one.
const MAX_ORBITAL_ANGLE: f32 = 40.0;
// A ray that moves inwards with du/dφ above this is captured: by (du/dφ)² = 1/b² − u² + u³ it is far inside the
// critical 1/b² = 4/27.
const CAPTURE_SLOPE: f32 = 10.0;

// u″ = −u + (3/2) u².
fn acceleration(u: f32) -> f32 {
    return u * (1.5 * u - 1.0);
}

// One RK4 step of length h in φ of (u, du/dφ).
fn step_phi(y: vec2<f32>, h: f32) -> vec2<f32> {
    let k1 = vec2(y.y, acceleration(y.x));
    let y2 = y + 0.5 * h * k1;
    let k2 = vec2(y2.y, acceleration(y2.x));
    let y3 = y + 0.5 * h * k2;
    let k3 = vec2(y3.y, acceleration(y3.x));
    let y4 = y + h * k3;
    let k4 = vec2(y4.y, acceleration(y4.x));
    return y + h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
}

// The φ from here to u = 0, by one RK4 step in u (Hénon): dφ/du = 1/v, dv/du = u″/v.
fn land(y: vec2<f32>) -> f32 {
    let h = -y.x;
    let m1 = 1.0 / y.y;
    let v2 = y.y + 0.5 * h * acceleration(y.x) * m1;
    let m2 = 1.0 / v2;
    let middle = acceleration(y.x + 0.5 * h);
    let v3 = y.y + 0.5 * h * middle * m2;
    let m3 = 1.0 / v3;
    // Only φ is returned, so the last stage needs no acceleration.
    let v4 = y.y + h * middle * m3;
    return h / 6.0 * (m1 + 2.0 * (m2 + m3) + 1.0 / v4);
}

fn deflect_direct(c: f32, p: f32) -> Deflected {
    var y = vec2(camera.inverse_radius, start_slope(c, p));
    if y.y > CAPTURE_SLOPE {
        return Deflected(CAPTURED, 0.0, 0.0, 0.0);
    }
    // Almost straight away from the hole the first step goes far beyond infinity, where the equation is unbounded.
    // The step may then return any number, so its result is ignored.
    let at_once = -y.y * STEP > 2.0 * y.x;
    let limit = u32(MAX_ORBITAL_ANGLE / STEP);
    for (var i = 0u; i < limit; i++) {
        let next = step_phi(y, STEP);
        if at_once || next.x <= 0.0 {
            // φ_∞ = π − θ′.
            let phi = cos_sin(f32(i) * STEP + land(y));
            return Deflected(ESCAPES, -phi.x, phi.y, 0.0);
        }
        if is_captured(next) {
            return Deflected(CAPTURED, 0.0, 0.0, 0.0);
        }
        y = next;
    }
    return Deflected(UNFINISHED, 0.0, 0.0, 0.0);
}
