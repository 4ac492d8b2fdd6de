// The disc in front of what is behind it. disc/seen.rs explains it and is the reference in f64.
//
// A software adapter executes both sides of a branch but leaves out a loop that none of its pixels takes. So what few pixels
// need is in loops of one turn.
// #import disc
// #import disc_hits
// #import disc_light

// The light of the disc, premultiplied by its alpha, and the share of the light behind it that gets through.
struct Veil {
    light: vec4<f32>,
    through: f32,
}

const NO_VEIL: Veil = Veil(vec4<f32>(0.0), 1.0);

// The disc in front of a patch away from the shadow's edge.
fn veil_of(seen: Patch, deflected: Deflected) -> Veil {
    let orbit = orbit_of(seen, 0.0);
    var inward = has_inward_leg(orbit);
    var outward = has_outward_leg(orbit) && deflected.outcome == ESCAPES;
    var nearer = NO_CROSSING;
    var farther = NO_CROSSING;
    let ray = leaving(deflected);
    var other = ray;
    for (var needed = inward || (outward && !orbit.reaches_inner); needed; needed = false) {
        other = opposite(seen);
    }
    let near = near_end(orbit, ray, other);
    for (; inward; inward = false) {
        nearer = crossing_of(inward_leg(seen, orbit, near, other), seen);
    }
    // What is behind an opaque part of the disc is not seen.
    outward = outward && disc.opacity * nearer.share < 1.0;
    for (; outward; outward = false) {
        farther = crossing_of(outward_leg(seen, orbit, near, ray), seen);
    }
    return veil(seen, orbit, nearer, farther);
}

// The disc in front of a patch beside the shadow's edge, beyond the periapsis of its rays. Such rays reach the inner rim.
fn veil_beyond(seen: Patch, orbit: Orbit, deflected: Deflected) -> Veil {
    let leg = outward_leg(seen, orbit, orbit.inner, leaving(deflected));
    return veil(seen, orbit, NO_CROSSING, crossing_of(leg, seen));
}

// The same before the periapsis, which captured rays do not reach.
fn veil_before(seen: Patch, orbit: Orbit) -> Veil {
    var nearer = NO_CROSSING;
    for (var inward = has_inward_leg(orbit); inward; inward = false) {
        nearer = crossing_of(inward_leg(seen, orbit, orbit.inner, opposite(seen)), seen);
    }
    return veil(seen, orbit, nearer, NO_CROSSING);
}

// The light of two crossings.
fn veil(seen: Patch, orbit: Orbit, nearer: Crossing, farther: Crossing) -> Veil {
    let k = disc.opacity;
    // The share in which the farther crossing is seen, and the share of what is behind both.
    let left = 1.0 - k * nearer.share;
    var shown = left * farther.share;
    var through = left * (1.0 - k * farther.share);
    if nearer.at_periapsis * farther.at_periapsis > 0.0 {
        // Where the periapsis is above the plane, a leg crosses it whose far end is below, and the reverse.
        let is_above = nearer.above.y;
        let one = is_above * (1.0 - k * (1.0 - nearer.above.x));
        let other = (1.0 - is_above) * (1.0 - k * nearer.above.x);
        shown = one * (1.0 - farther.above.x) + other * farther.above.x;
        through = one * (1.0 - k * (1.0 - farther.above.x)) + other * (1.0 - k * farther.above.x);
    }
    var light = vec4(0.0);
    for (var lit = nearer.share > 0.0; lit; lit = false) {
        light += vec4(disc_light(seen, orbit, nearer.phase), 1.0) * (k * nearer.share);
    }
    for (var lit = shown > 0.0; lit; lit = false) {
        light += vec4(disc_light(seen, orbit, farther.phase), 1.0) * (k * shown);
    }
    return Veil(light, through);
}
