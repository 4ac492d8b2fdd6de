// The filtered picture by one program for all pixels.
// #import filter
// #import keep
// #import region

// The mean light of pixel `id` of the region. A software adapter executes both sides of a branch, so the pixels with one
// ray take the first turn of the loop of those with several.
fn pixel(id: vec2<u32>) -> vec4<f32> {
    let at = from_middle(region.first + id);
    let whole = patch_at(at, 1.0);
    return kept(id, light_by(rays_of(whole), whole, at));
}
