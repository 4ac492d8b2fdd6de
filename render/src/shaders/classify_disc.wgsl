// Tile classification with a disc: the tiles in which it may be seen are in the work queue of those beside the shadow's
// edge.
// #import classify_tiles
// #import disc_hits

// Whether a leg may meet the disc within a patch. `uncertain` bounds the change of the phases of its far and its near end
// within the patch where they change like a square root.
fn may_cross(leg: Leg, seen: Patch, uncertain: vec2<f32>) -> bool {
    let far = leg.far;
    let near = leg.near;
    let above = vec4(
        share_above(leg, End(far.kind, Varying(far.phase.value - uncertain.x, far.phase.slope)), seen),
        share_above(leg, End(far.kind, Varying(far.phase.value + uncertain.x, far.phase.slope)), seen),
        share_above(leg, End(near.kind, Varying(near.phase.value - uncertain.y, near.phase.slope)), seen),
        share_above(leg, End(near.kind, Varying(near.phase.value + uncertain.y, near.phase.slope)), seen),
    );
    return any(above > vec4(0.0)) && any(above < vec4(1.0));
}

// Bound on the change of the phase at a rim of inverse radius u within a patch in which m² changes by `slack`: that of a
// square root if it reaches 0 there.
fn uncertainty(speed_sq: f32, slack: f32, u: f32) -> f32 {
    return select(0.0, 2.0 * sqrt(slack) / u, abs(speed_sq) < slack);
}

// Whether a tile may show the disc. The heights at the ends of its legs are bounded over a patch of twice the tile's size.
fn may_show_disc(corner: vec2<f32>) -> bool {
    let at = corner + 0.5 * f32(TILE) - 0.5 * vec2<f32>(camera.size);
    let seen = patch_at(at, 2.0 * f32(TILE));
    let middle = orbit_of(seen, 0.0).inv_b_sq;
    let slack = abs(middle.slope) * gradient(seen);
    // A tile of which only a part comes near enough to the hole counts as if its middle just did.
    let missing = disc.outer_least - middle.value;
    let orbit = orbit_of(seen, select(0.0, missing * 1.00001, missing > 0.0 && missing < slack));
    if !has_inward_leg(orbit) && !has_outward_leg(orbit) {
        return false;
    }
    let ray = leaving(deflect_patch(seen.c, seen.p));
    let other = opposite(seen);
    let uncertain = vec2(
        uncertainty(orbit.inv_b_sq.value - disc.outer_least, slack, disc.outer_u),
        uncertainty(orbit.inv_b_sq.value - disc.inner_least, slack, disc.inner_u),
    );
    return (has_inward_leg(orbit) && may_cross(inward_leg(seen, orbit, ray, other), seen, uncertain))
        || (has_outward_leg(orbit) && may_cross(outward_leg(seen, orbit, ray, other), seen, uncertain));
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
