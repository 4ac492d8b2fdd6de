// The filtered picture by one program for all pixels.
// #import filter
// #import keep
// #import region

// The mean light of pixel `id` of the region. A software adapter executes both sides of a branch but leaves out a loop
// that none of its pixels takes, so only the many rays beside the shadow's edge are those of a loop.
fn pixel(id: vec2<u32>) -> vec4<f32> {
    let at = from_middle(region.first + id);
    let whole = patch_at(at, 1.0);
    var rays = rays_of(whole);
    var light = vec4(0.0);
    if rays.along == 1u {
        light = patch_light(whole, rays.most_taps);
        rays.along = 0u;
    }
    return kept(id, light + light_by(rays, at));
}
