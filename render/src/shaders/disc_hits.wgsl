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

// The polynomial with the coefficients `four`, lowest first, plus t⁴ times the polynomial `above`, each with its derivative.
fn lower_powers(t: f32, above: vec2<f32>, four: vec4<f32>) -> vec2<f32> {
    var p = vec2(above.x * t + four.w, above.y * t + above.x);
    p = vec2(p.x * t + four.z, p.y * t + p.x);
    p = vec2(p.x * t + four.y, p.y * t + p.x);
    return vec2(p.x * t + four.x, p.y * t + p.x);
}

// The phase of the inner rim and its derivative at t = 4α/π − 1; then of the outer rim, and of the observer. A software adapter looks up an element
// of an array one pixel at a time, unless its index is a constant.
fn inner_phase(t: f32) -> vec2<f32> {
    let high = lower_powers(t, vec2(0.0), disc.phases[2]);
    return lower_powers(t, lower_powers(t, high, disc.phases[1]), disc.phases[0]);
}

fn outer_phase(t: f32) -> vec2<f32> {
    let high = lower_powers(t, vec2(0.0), disc.phases[5]);
    return lower_powers(t, lower_powers(t, high, disc.phases[4]), disc.phases[3]);
}

fn observer_phase(t: f32) -> vec2<f32> {
    let high = lower_powers(t, vec2(0.0), disc.phases[8]);
    return lower_powers(t, lower_powers(t, high, disc.phases[7]), disc.phases[6]);
}

// t = 4α/π − 1 of a ray with this m at the rim of inverse radius u.
fn rim_place(u: f32, speed: f32) -> f32 {
    return angle(speed, u) * 1.2732395 - 1.0;
}

// The end of a leg at the rim of inverse radius u, from its phase and the derivative of that by t. It changes like a square root where rays have their periapsis
// there, so m² is at least `least_speed_sq` in its derivative.
fn at_rim(u: f32, speed_sq: f32, phase: vec2<f32>, inv_b_sq: Varying, least_speed_sq: f32) -> End {
    let bounded = max(max(speed_sq, least_speed_sq), 1e-20);
    let by_square = -0.63661975 * u * inverseSqrt(bounded) / (u * u + bounded);
    let slope = phase.y * by_square * inv_b_sq.slope;
    return End(AT_RIM, Varying(phase.x, slope), cos_sin(phase.x));
}

// The redshift factor of the ray through the middle of a patch, in parts: that of light from the direction of the hole, and of
// light from straight away.
fn redshift_parts(seen: Patch) -> vec2<f32> {
    return 0.5 * orbit_redshifts() * vec2(1.0 + seen.c, 1.0 - seen.c);
}

// 1/b² of the ray through the middle of a patch.
fn inv_b_sq_of(seen: Patch) -> Varying {
    let z = orbit_redshifts();
    let p = max(seen.p, 1e-6);
    let parts = redshift_parts(seen);
    let redshift = parts.x + parts.y;
    let inv_b = camera.inverse_radius * redshift / p;
    let slope = camera.inverse_radius * (0.5 * (z.y - z.x) - redshift * seen.c / (p * p));
    return Varying(inv_b * inv_b, 2.0 * inv_b * slope);
}

// The orbit of the ray through the middle of a patch. `more` is added to 1/b².
fn orbit_of(seen: Patch, more: f32) -> Orbit {
    let parts = redshift_parts(seen);
    var square = inv_b_sq_of(seen);
    square.value += more;
    let least = 0.25 * abs(square.slope) * gradient(seen);
    let inner_sq = square.value - disc.inner_least;
    let outer_sq = square.value - disc.outer_least;
    return Orbit(
        square,
        parts.x > parts.y,
        1.0 / (camera.inverse_radius * (parts.x + parts.y)),
        at_rim(disc.inner_u, inner_sq, inner_phase(rim_place(disc.inner_u, sqrt(max(inner_sq, 0.0)))), square, least),
        at_rim(disc.outer_u, outer_sq, outer_phase(rim_place(disc.outer_u, sqrt(max(outer_sq, 0.0)))), square, least),
        inner_sq >= 0.0,
        outer_sq >= 0.0,
    );
}

fn leaving(deflected: Deflected) -> Leaving {
    return Leaving(vec2(-deflected.cos_sky, deflected.sin_sky), -deflected.radial);
}

// The ray that leaves the observer opposite to the one through the middle of a patch, which leaves inwards: its φ_∞ is the
// phase of the observer, since that ray comes from there. m = u (z_in cot(θ/2) − z_out tan(θ/2))/2.
fn opposite(seen: Patch) -> Leaving {
    let z = orbit_redshifts();
    let u = camera.inverse_radius;
    let p = max(seen.p, 1e-6);
    let speed = 0.5 * u * (z.x * (1.0 + seen.c) - z.y * (1.0 - seen.c)) / p;
    let phase = observer_phase(rim_place(u, max(speed, 0.0)));
    let by_angle = -0.5 * u * (z.x * (1.0 + seen.c) + z.y * (1.0 - seen.c)) / (p * p);
    let turn = phase.y * -1.2732395 * u / (u * u + speed * speed) * by_angle;
    return Leaving(cos_sin(phase.x), turn);
}

// The end of a leg at the periapsis: half of the angle between the two ends of the path.
fn at_periapsis(ray: Leaving, other: Leaving) -> End {
    let whole = vec2(
        ray.sky.x * other.sky.x - ray.sky.y * other.sky.y,
        ray.sky.y * other.sky.x + ray.sky.x * other.sky.y,
    );
    let phase = 0.5 * full_angle(whole);
    return End(AT_PERIAPSIS, Varying(phase, 0.5 * (ray.turn + other.turn)), cos_sin(phase));
}

fn at_observer(ray: Leaving) -> End {
    return End(AT_OBSERVER, Varying(full_angle(ray.sky), 0.0), ray.sky);
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

// Whether the leg on which rays of this orbit leave for the sky can meet the disc.
fn has_outward_leg(orbit: Orbit) -> bool {
    return orbit.reaches_outer && (orbit.inwards || camera.inverse_radius > disc.outer_u);
}

// The leg before the periapsis.
fn inward_leg(seen: Patch, orbit: Orbit, near: End, other: Leaving) -> Leg {
    var far = orbit.outer;
    if camera.inverse_radius >= disc.outer_u {
        far = at_observer(other);
    }
    let axis = axis_in_plane(seen) * vec3(1.0, -1.0, -1.0);
    return Leg(other.sky, other.turn, axis, -1.0, far, near);
}

// The leg beyond the periapsis, or beyond an observer whom the ray leaves outwards.
fn outward_leg(seen: Patch, orbit: Orbit, near: End, ray: Leaving) -> Leg {
    var first = near;
    if !orbit.inwards && camera.inverse_radius <= disc.inner_u {
        first = at_observer(ray);
    }
    return Leg(ray.sky, ray.turn, axis_in_plane(seen), 1.0, orbit.outer, first);
}
