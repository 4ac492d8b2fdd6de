// The light of the stars on a pixel, summed up for a whole column of a tile at a time: a tile is a group, so that the pixels
// of its columns read the same list, and a node is loaded and unpacked once for eight pixels.
// #import constants
// #import kernel
// #import star_lists

// The light on the upper four pixels of the column and on the lower four, each in red, green and blue.
var<private> upper: array<vec4<f32>, 3>;
var<private> lower: array<vec4<f32>, 3>;

// Sums up the light on the column of a tile that holds the pixel `first`.
fn begin_column(first: vec2<u32>) {
    let group = group_of(first);
    let x = f32(first.x - first_pixel(group).x) + 0.5;
    let middles = vec4(0.5, 1.5, 2.5, 3.5);
    var next = first_node(group);
    upper = array<vec4<f32>, 3>();
    lower = array<vec4<f32>, 3>();
    // The loop tests for the end after each node: see star_list.wgsl.
    loop {
        let node = unpacked(textureLoad(nodes, texel_of(next), 0));
        let above = kernel_shares(x - node.at.x, middles - node.at.y, node.kernel);
        let below = kernel_shares(x - node.at.x, middles + 4.0 - node.at.y, node.kernel);
        upper[0] += node.light.r * above;
        upper[1] += node.light.g * above;
        upper[2] += node.light.b * above;
        lower[0] += node.light.r * below;
        lower[1] += node.light.g * below;
        lower[2] += node.light.b * below;
        next = node.next;
        if next == 0u {
            break;
        }
    }
}

// The light on a pixel of the column.
fn star_light(pixel: vec2<u32>) -> vec3<f32> {
    let row = pixel.y % TILE;
    let i = row % 4u;
    return select(
        vec3(lower[0][i], lower[1][i], lower[2][i]),
        vec3(upper[0][i], upper[1][i], upper[2][i]),
        row < 4u,
    );
}
