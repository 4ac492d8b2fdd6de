// Tile classification with a disc: the tiles in which it may be seen are in the work queue of those beside the shadow's
// edge.
// #import classify_tiles
// #import disc_hits

// The shares of a patch in which an end of a leg is above the disc, for the bounds of its phase. `uncertain` is how much
// that changes within the patch where it changes like a square root; 0 elsewhere.
fn bounds_above(leg: Leg, end: End, seen: Patch, uncertain: f32) -> vec2<f32> {
    if uncertain == 0.0 {
        return vec2(share_above(leg, end, seen));
    }
    let less = end.phase.value - uncertain;
    let more = end.phase.value + uncertain;
    return vec2(
        share_above(leg, End(end.kind, Varying(less, 0.0), cos_sin(less)), seen),
        share_above(leg, End(end.kind, Varying(more, 0.0), cos_sin(more)), seen),
    );
}

// Whether a leg may meet the disc within a patch.
fn may_cross(leg: Leg, seen: Patch, uncertain: vec2<f32>) -> bool {
    let above = vec4(
        bounds_above(leg, leg.far, seen, uncertain.x),
        bounds_above(leg, leg.near, seen, uncertain.y),
    );
    return any(above > vec4(0.0)) && any(above < vec4(1.0));
}

// Bound on the change of the phase at a rim of inverse radius u within a patch in which m² changes by ± `slack`: that of a
// square root if it reaches 0 there.
fn uncertainty(speed_sq: f32, slack: f32, u: f32) -> f32 {
    return select(0.0, sqrt(2.0 * slack) / u, abs(speed_sq) < slack);
}

// Whether a tile may show the disc. The heights at the ends of its legs are bounded over a patch of twice its size.
fn may_show_disc(corner: vec2<f32>) -> bool {
    let at = corner + 0.5 * f32(TILE) - 0.5 * vec2<f32>(camera.size);
    let seen = patch_at(at, 2.0 * f32(TILE));
    let middle = inv_b_sq_of(seen);
    let slack = 0.6 * abs(middle.slope) * gradient(seen);
    // A tile of which only a part comes near enough to the hole counts as if its middle just did.
    let missing = disc.outer_least - middle.value;
    let orbit = orbit_of(seen, select(0.0, missing * 1.00001, missing > 0.0 && missing < slack));
    var found = false;
    if has_inward_leg(orbit) || has_outward_leg(orbit) {
        found = may_meet_disc(seen, orbit, slack);
    }
    return found;
}

// Whether rays of this orbit may meet the disc within a patch in which m² changes by ± `slack`.
fn may_meet_disc(seen: Patch, orbit: Orbit, slack: f32) -> bool {
    let ray = leaving(deflect_patch(seen.c, seen.p));
    let other = opposite(seen);
    var near = orbit.inner;
    if !orbit.reaches_inner {
        near = at_periapsis(ray, other);
    }
    let uncertain = vec2(
        uncertainty(orbit.inv_b_sq.value - disc.outer_least, slack, disc.outer_u),
        uncertainty(orbit.inv_b_sq.value - disc.inner_least, slack, disc.inner_u),
    );
    // Heights repeat after a turn: a bound as wide as half of one is none.
    if max(uncertain.x, uncertain.y) > 0.5 * HALF_TURN {
        return true;
    }
    return (has_inward_leg(orbit) && may_cross(inward_leg(seen, orbit, near, other), seen, uncertain))
        || (has_outward_leg(orbit) && may_cross(outward_leg(seen, orbit, near, ray), seen, uncertain));
}

@compute @workgroup_size(64)
fn classify_disc_tiles(@builtin(global_invocation_id) id: vec3<u32>) {
    let across = tiles_of_region().x;
    let tile = vec2(id.x % across, id.x / across);
    if tile.y < tiles_of_region().y {
        let corner = vec2<f32>(region.first + TILE * tile);
        let queue = select(class_of_tile(corner), MANY_RAYS, may_show_disc(corner));
        let entry = atomicAdd(&queues[region.queues + queue].count, 1u);
        tiles[first_tile(queue) + entry] = tile.x | (tile.y << 16u);
    }
}
