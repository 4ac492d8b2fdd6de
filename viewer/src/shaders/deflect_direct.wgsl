// RK4 along the ray turns the light: the textbook way, forward from the observer, in f32. It knows
// nothing of the table nor of the shadow's edge. Needs before it `const STEP: f32`, the step of orbital
// angle in rad: a constant, for a driver may compile a shader anew for every value of a uniform that it
// loops by.

// No ray that f32 can tell from a captured one turns further, rad.
const LONGEST_WAY: f32 = 40.0;
// Inwards with (du/dφ)² = 1/b² − u² + u³ above this is far inside the critical 1/b² = 4/27.
const PLUNGE: f32 = 10.0;

// u″ = −u + (3/2) u².
fn acceleration(u: f32) -> f32 {
    return u * (1.5 * u - 1.0);
}

// One step of length h in φ of (u, du/dφ).
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

// The φ that is left until u = 0, by one step in u (Hénon): dφ/du = 1/v, dv/du = u″/v.
fn land(y: vec2<f32>) -> f32 {
    let h = -y.x;
    let m1 = 1.0 / y.y;
    let v2 = y.y + 0.5 * h * acceleration(y.x) * m1;
    let m2 = 1.0 / v2;
    let middle = acceleration(y.x + 0.5 * h);
    let v3 = y.y + 0.5 * h * middle * m2;
    let m3 = 1.0 / v3;
    // u″ vanishes at the landing, so the last velocity needs the middle one only.
    let v4 = y.y + h * middle * m3;
    return h / 6.0 * (m1 + 2.0 * (m2 + m3) + 1.0 / v4);
}

fn deflect_direct(c: f32, p: f32) -> Turned {
    // du/dφ = u √(1−u) cot θ, positive towards the hole.
    var y = vec2(frame.u, frame.u * frame.lapse * c / max(p, 1e-20));
    if y.y > PLUNGE {
        return Turned(CAPTURED, 0.0, 0.0, 0.0);
    }
    // Almost straight away from the hole the first step goes far beyond infinity, where the equation is
    // unbounded: it may return any number, and is not looked at.
    let at_once = -y.y * STEP > 2.0 * y.x;
    let limit = u32(LONGEST_WAY / STEP);
    for (var i = 0u; i < limit; i++) {
        let next = step_phi(y, STEP);
        if at_once || next.x <= 0.0 {
            // φ_∞ = π − θ′.
            let phi = cos_sin(f32(i) * STEP + land(y));
            return Turned(ESCAPES, -phi.x, phi.y, 0.0);
        }
        if next.x >= 1.0 {
            return Turned(CAPTURED, 0.0, 0.0, 0.0);
        }
        y = next;
    }
    return Turned(UNFINISHED, 0.0, 0.0, 0.0);
}
