// A render pass draws each region to its place in a texture of the whole picture.
// #import region
fn origin() -> vec2<u32> {
    return region.first;
}
