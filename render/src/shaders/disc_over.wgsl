// How a disc covers what is behind it. disc/seen.rs explains it and is the reference in f64.
// #import disc
// #import disc_hits
// #import disc_light

// What a patch needs to know of its rays on the side of the observer: the end of their legs near the hole, and the crossing
// before it.
struct Before {
    near: End,
    nearer: Crossing,
}

// The rays of a patch before their periapsis. `ray` is where they leave for the sky, if they do.
fn before_periapsis(whole: Patch, orbit: Orbit, ray: Leaving) -> Before {
    var before = Before(orbit.inner, NO_CROSSING);
    let inward = has_inward_leg(orbit);
    if inward || !orbit.reaches_inner {
        let other = opposite(whole);
        if !orbit.reaches_inner {
            before.near = at_periapsis(ray, other);
        }
        if inward {
            before.nearer = crossing_of(inward_leg(whole, orbit, before.near, other), whole);
        }
    }
    return before;
}

// The crossing beyond the periapsis, of rays that escape like `ray`, unless an opaque crossing hides it.
fn beyond_periapsis(outside: Patch, orbit: Orbit, ray: Leaving, before: Before) -> Crossing {
    var farther = NO_CROSSING;
    let is_seen = has_outward_leg(orbit) && disc.opacity * before.nearer.share < 1.0;
    if is_seen {
        var near = orbit.inner;
        if !orbit.reaches_inner {
            near = before.near;
        }
        farther = crossing_of(outward_leg(outside, orbit, near, ray), outside);
    }
    return farther;
}

// The share of a patch in which the farther crossing is seen, and the share of what is behind both.
fn shares_behind(nearer: Crossing, farther: Crossing) -> vec2<f32> {
    let k = disc.opacity;
    if nearer.at_periapsis * farther.at_periapsis > 0.0 {
        // Where the periapsis is above the plane, a leg crosses it whose far end is below, and the reverse.
        let is_above = nearer.above.y;
        let one = is_above * (1.0 - k * (1.0 - nearer.above.x));
        let other = (1.0 - is_above) * (1.0 - k * nearer.above.x);
        return vec2(
            one * (1.0 - farther.above.x) + other * farther.above.x,
            one * (1.0 - k * (1.0 - farther.above.x)) + other * (1.0 - k * farther.above.x),
        );
    }
    let left = 1.0 - k * nearer.share;
    return vec2(left * farther.share, left * (1.0 - k * farther.share));
}

// The light of a crossing that is seen in a share of the patch, premultiplied by its alpha.
fn light_of(seen: Patch, orbit: Orbit, crossing: Crossing, share: f32) -> vec4<f32> {
    var light = vec4(0.0);
    if share > 0.0 {
        light = vec4(disc_light(seen, orbit, crossing), 1.0) * (disc.opacity * share);
    }
    return light;
}
