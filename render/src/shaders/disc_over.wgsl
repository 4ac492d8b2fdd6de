// The light behind a disc, and the disc in front of it. disc/seen.rs explains it and is the reference in f64.
// #import disc
// #import disc_hits
// #import disc_light

// Light, premultiplied by its alpha, and the share of the light of stars behind the disc that gets through.
struct Veiled {
    light: vec4<f32>,
    through: f32,
}

// The light `behind`, seen through the legs of the rays of a patch. `escapes` is whether it has a leg beyond its periapsis.
fn behind_disc(seen: Patch, deflected: Deflected, behind: Veiled) -> Veiled {
    let orbit = orbit_of(seen, 0.0);
    let inward = has_inward_leg(orbit);
    let outward = has_outward_leg(orbit) && deflected.outcome == ESCAPES;
    if !inward && !outward {
        return behind;
    }
    let ray = leaving(deflected);
    let other = opposite(seen);
    var nearer = NO_CROSSING;
    var farther = NO_CROSSING;
    if inward {
        nearer = crossing_of(inward_leg(seen, orbit, ray, other), seen);
    }
    if outward {
        farther = crossing_of(outward_leg(seen, orbit, ray, other), seen);
    }
    return veiled(seen, orbit, nearer, farther, behind);
}

fn veiled(seen: Patch, orbit: Orbit, nearer: Crossing, farther: Crossing, behind: Veiled) -> Veiled {
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
    var light = behind.light * through;
    if nearer.share > 0.0 {
        light += vec4(disc_light(seen, orbit, nearer.phase), 1.0) * (k * nearer.share);
    }
    if shown > 0.0 {
        light += vec4(disc_light(seen, orbit, farther.phase), 1.0) * (k * shown);
    }
    return Veiled(light, behind.through * through);
}

// The light `behind` a patch beside the shadow's edge, seen through the disc beyond the periapsis of its rays.
fn behind_outward(seen: Patch, deflected: Deflected, behind: Veiled) -> Veiled {
    let orbit = orbit_of(seen, 0.0);
    if !has_outward_leg(orbit) {
        return behind;
    }
    let ray = leaving(deflected);
    // Such rays reach the inner rim, so the ray opposite is not needed.
    return veiled(seen, orbit, NO_CROSSING, crossing_of(outward_leg(seen, orbit, ray, ray), seen), behind);
}

// The same before the periapsis, which captured rays do not reach.
fn behind_inward(seen: Patch, behind: Veiled) -> Veiled {
    let orbit = orbit_of(seen, 0.0);
    if !has_inward_leg(orbit) {
        return behind;
    }
    let other = opposite(seen);
    return veiled(seen, orbit, crossing_of(inward_leg(seen, orbit, other, other), seen), NO_CROSSING, behind);
}
