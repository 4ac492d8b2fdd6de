// Where the rays of a patch of the picture meet the disc. disc/seen.rs is the reference in f64.
// #import arithmetic
// #import camera
// #import deflect
// #import disc
// #import disc_leg
// #import disc_orbit

// What a ray needs to know of its orbit: 1/b² and its derivative by the view angle, whether it leaves the observer
// inwards, b/sin θ, and where it reaches the rims.
struct Orbit {
    inv_b_sq: Varying,
    inwards: bool,
    by_sine: f32,
    inner: End,
    outer: End,
    reaches_inner: bool,
    reaches_outer: bool,
}

// A ray that leaves the observer for the sky: (cos φ_∞, sin φ_∞) and dφ_∞/dθ.
struct Leaving {
    sky: vec2<f32>,
    turn: f32,
}

// The coefficients of a rim's phase begin at `first`. The polynomial and its derivative at t = 4α/π − 1.
fn rim_phase(t: f32, first: u32) -> vec2<f32> {
    var value = 0.0;
    var slope = 0.0;
    for (var i = 3u; i > 0u; i--) {
        let four = disc.phases[first + i - 1u];
        slope = slope * t + value;
        value = value * t + four.w;
        slope = slope * t + value;
        value = value * t + four.z;
        slope = slope * t + value;
        value = value * t + four.y;
        slope = slope * t + value;
        value = value * t + four.x;
    }
    return vec2(value, slope);
}

// The end of a leg at the rim of inverse radius u. Its phase changes like a square root where rays have their periapsis
// there, so m² is at least `least_speed_sq` in its derivative.
fn at_rim(u: f32, speed_sq: f32, first: u32, inv_b_sq: Varying, least_speed_sq: f32) -> End {
    let phase = rim_phase(angle(sqrt(max(speed_sq, 0.0)), u) * 1.2732395 - 1.0, first);
    let bounded = max(max(speed_sq, least_speed_sq), 1e-20);
    let by_square = -0.63661975 * u * inverseSqrt(bounded) / (u * u + bounded);
    return End(AT_RIM, Varying(phase.x, phase.y * by_square * inv_b_sq.slope));
}

// The orbit of the ray through the middle of a patch. `more` is added to 1/b².
fn orbit_of(seen: Patch, more: f32) -> Orbit {
    let z = orbit_redshifts();
    let p = max(seen.p, 1e-6);
    let towards = 0.5 * z.x * (1.0 + seen.c);
    let away = 0.5 * z.y * (1.0 - seen.c);
    let redshift = towards + away;
    let inv_b = camera.inverse_radius * redshift / p;
    let slope = camera.inverse_radius * (0.5 * (z.y - z.x) - redshift * seen.c / (p * p));
    let square = Varying(inv_b * inv_b + more, 2.0 * inv_b * slope);
    let least = 0.25 * abs(square.slope) * gradient(seen);
    let inner_sq = square.value - disc.inner_least;
    let outer_sq = square.value - disc.outer_least;
    return Orbit(
        square,
        towards > away,
        1.0 / (camera.inverse_radius * redshift),
        at_rim(disc.inner_u, inner_sq, 0u, square, least),
        at_rim(disc.outer_u, outer_sq, 3u, square, least),
        inner_sq >= 0.0,
        outer_sq >= 0.0,
    );
}

fn leaving(deflected: Deflected) -> Leaving {
    return Leaving(vec2(-deflected.cos_sky, deflected.sin_sky), deflected.slope - 1.0);
}

// The ray that leaves the observer opposite to the one through the middle of a patch, in the frame of the observer at
// rest: tan(θ′/2) = (z_in/z_out) cot(θ/2).
fn opposite(seen: Patch) -> Leaving {
    let z = orbit_redshifts();
    let ratio = z.x / z.y;
    let ahead = ratio * ratio * (1.0 + seen.c);
    let behind = 1.0 - seen.c;
    let sum = ahead + behind;
    let p = 2.0 * ratio * seen.p / sum;
    let ray = leaving(deflect_patch((behind - ahead) / sum, p));
    return Leaving(ray.sky, -ray.turn * p / max(seen.p, 1e-6));
}

// The end of a leg at the periapsis: half of the angle between the two ends of the path.
fn at_periapsis(ray: Leaving, other: Leaving) -> End {
    let whole = vec2(
        ray.sky.x * other.sky.x - ray.sky.y * other.sky.y,
        ray.sky.y * other.sky.x + ray.sky.x * other.sky.y,
    );
    return End(AT_PERIAPSIS, Varying(0.5 * full_angle(whole), 0.5 * (ray.turn + other.turn)));
}

fn at_observer(ray: Leaving) -> End {
    return End(AT_OBSERVER, Varying(full_angle(ray.sky), 0.0));
}

fn end_of(condition: bool, yes: End, no: End) -> End {
    return End(
        select(no.kind, yes.kind, condition),
        Varying(
            select(no.phase.value, yes.phase.value, condition),
            select(no.phase.slope, yes.phase.slope, condition),
        ),
    );
}

// The axis of the disc in the plane of the ray through the middle of a patch.
fn axis_in_plane(seen: Patch) -> vec3<f32> {
    let e = vec2(seen.tangential.y, -seen.tangential.x);
    return vec3(disc.axis.z, dot(disc.axis.xy, e), dot(disc.axis.xy, seen.tangential.xy));
}

// Whether the leg on which rays of this orbit come in to the observer can meet the disc.
fn has_inward_leg(orbit: Orbit) -> bool {
    let u = camera.inverse_radius;
    return orbit.inwards && u < disc.inner_u && (u >= disc.outer_u || orbit.reaches_outer);
}

// The leg before the periapsis, of a ray that leaves like `ray` if it escapes.
fn inward_leg(seen: Patch, orbit: Orbit, ray: Leaving, other: Leaving) -> Leg {
    return Leg(
        other.sky,
        other.turn,
        axis_in_plane(seen) * vec3(1.0, -1.0, -1.0),
        -1.0,
        end_of(camera.inverse_radius >= disc.outer_u, at_observer(other), orbit.outer),
        end_of(orbit.reaches_inner, orbit.inner, at_periapsis(ray, other)),
    );
}

// Whether the leg on which rays of this orbit leave for the sky can meet the disc.
fn has_outward_leg(orbit: Orbit) -> bool {
    return orbit.reaches_outer && (orbit.inwards || camera.inverse_radius > disc.outer_u);
}

// The leg beyond the periapsis of the ray that leaves like `ray`.
fn outward_leg(seen: Patch, orbit: Orbit, ray: Leaving, other: Leaving) -> Leg {
    let from_observer = !orbit.inwards && camera.inverse_radius <= disc.inner_u;
    let turning = end_of(orbit.reaches_inner, orbit.inner, at_periapsis(ray, other));
    return Leg(
        ray.sky,
        ray.turn,
        axis_in_plane(seen),
        1.0,
        orbit.outer,
        end_of(from_observer, at_observer(ray), turning),
    );
}
