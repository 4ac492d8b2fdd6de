// A render pass draws each region to the upper left corner of its target.
fn origin() -> vec2<u32> {
    return vec2(0u);
}
