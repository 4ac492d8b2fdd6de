// One leg of a ray, and where it meets the disc. disc/leg.rs explains the method and is the reference in f64.
// #import arithmetic
// #import camera
// #import coverage
// #import patch
// #import shadow

// An angle, or a quantity along a ray, with its derivative by the view angle θ.
struct Varying {
    value: f32,
    slope: f32,
}

// Kinds of ends of a leg.
const AT_RIM: u32 = 0u;
const AT_PERIAPSIS: u32 = 1u;
const AT_OBSERVER: u32 = 2u;

// An end of a leg: its phase, and the cos and sin of that phase.
struct End {
    kind: u32,
    phase: Varying,
    turned: vec2<f32>,
}

struct Leg {
    // (cos φ_∞, sin φ_∞) and dφ_∞/dθ.
    sky: vec2<f32>,
    turn: f32,
    // The axis of the disc: its component along the outward axis Z, along the unit vector e in the plane of the ray
    // across Z, and across that plane.
    axis: vec3<f32>,
    // 1, or −1 for the mirrored leg that light comes in on.
    side: f32,
    // The end nearer to the sky, and the one nearer to the hole.
    far: End,
    near: End,
}

struct Crossing {
    // The share of the patch in which the leg meets the disc.
    share: f32,
    phase: f32,
    // The shares in which the heights at the far end and at the near end are positive.
    above: vec2<f32>,
    // 1 if the near end is the periapsis.
    at_periapsis: f32,
    // Of its leg: (cos φ_∞, sin φ_∞), dφ_∞/dθ, and its side.
    sky: vec2<f32>,
    turn: f32,
    side: f32,
}

const NO_CROSSING: Crossing = Crossing(0.0, 0.0, vec2<f32>(0.0), 0.0, vec2<f32>(0.0), 0.0, 0.0);
const FAST_TURN: f32 = 0.25;

// The angle in [0, 2π) of the unit vector v.
fn full_angle(v: vec2<f32>) -> f32 {
    let half = angle(v.x, abs(v.y));
    return select(half, 2.0 * HALF_TURN - half, v.y < 0.0);
}

// The share of the patch in which an end of the leg is above the disc.
fn share_above(leg: Leg, end: End, seen: Patch) -> f32 {
    if end.kind == AT_OBSERVER {
        let height = select(leg.axis.x, leg.side * leg.axis.y, leg.axis.x == 0.0);
        return select(0.0, 1.0, height > 0.0);
    }
    let t = end.turned;
    let at = vec2(dot(leg.sky, t), leg.sky.y * t.x - leg.sky.x * t.y);
    let height = dot(leg.axis.xy, at);
    let radial = (leg.axis.y * at.x - leg.axis.x * at.y) * (leg.turn - end.phase.slope);
    let tangential = leg.axis.z * at.y / max(seen.p, 1e-6);
    return positive_share(
        height,
        radial * seen.right.x + tangential * seen.right.y,
        radial * seen.down.x + tangential * seen.down.y,
    );
}

// Where the leg meets the disc in a patch.
fn crossing_of(leg: Leg, seen: Patch) -> Crossing {
    let low = leg.far.phase.value;
    let high = leg.near.phase.value;
    let above = vec2(share_above(leg, leg.far, seen), share_above(leg, leg.near, seen));
    let px = gradient(seen);
    let is_crowded = leg.side > 0.0 && abs(leg.turn) * px > FAST_TURN;
    var share = abs(above.x - above.y);
    var phase = low;
    if low < high && (share > 0.0 || is_crowded) {
        // The phase in [0, π) at which the leg is in the plane of the disc.
        let cross = dot(leg.axis.xy, leg.sky);
        let along = leg.axis.y * leg.sky.x - leg.axis.x * leg.sky.y;
        let in_plane = angle(select(-along, along, cross >= 0.0), abs(cross));
        // Of phases that differ by half a turn, the one nearest to the disc.
        phase = select(in_plane, in_plane - HALF_TURN, 2.0 * in_plane - HALF_TURN > low + high);
        if is_crowded {
            let middle = max(shadow_distance(seen.c, seen.p, half_shadow()), 1e-9);
            let found = crowded_share(middle, 0.5 * px, in_plane, abs(leg.turn) * middle, low, high);
            share = found.x;
            phase = found.y;
        }
    }
    return Crossing(
        select(0.0, share, low < high),
        clamp(phase, low, high),
        above,
        select(0.0, 1.0, leg.near.kind == AT_PERIAPSIS),
        leg.sky,
        leg.turn,
        leg.side,
    );
}
