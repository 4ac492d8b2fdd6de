// Inserts the light of the stars into linked lists, which the picture sums up: one invocation for each image
// of a star, then one for each piece of an arc. stars/draw.rs is the reference in f64.
// #import arithmetic
// #import camera
// #import constants
// #import inverse_lens
// #import kernel
// #import observe
// #import shift
// #import star_images
// #import star_list_heads
// #import star_node

struct Star {
    // In the sky frame.
    direction: vec3<f32>,
    light: vec3<f32>,
}

// A piece of an arc: light at a point of the picture.
struct Piece {
    at: vec2<f32>,
    kernel: u32,
    light: vec3<f32>,
}

@group(0) @binding(2) var<storage, read> stars: array<Star>;
@group(0) @binding(3) var<storage, read> pieces: array<Piece>;
// The images that the picture may show: the index of the star in the lower 24 bits, and above them the image
// order.
@group(0) @binding(4) var<storage, read> candidates: array<u32>;
@group(0) @binding(5) var<storage, read_write> list_heads: array<atomic<u32>>;
@group(0) @binding(6) var nodes: texture_storage_2d<rgba32uint, write>;

// Index of the head of the list that a node of a group is inserted into.
fn list_head(group: vec2<u32>, node: u32) -> u32 {
    let index = index_of(group);
    if node < UNCOUNTED {
        return group_head(index);
    }
    let full = atomicAdd(&list_heads[group_head(groups()) + index / 2u], 1u) / LIST;
    if full == 0u {
        return group_head(index);
    }
    return overflow_head((index + 1u) * OVERFLOWS_PER_GROUP + full);
}

fn groups() -> u32 {
    return groups_across() * ((camera.size.y + GROUP_HEIGHT - 1u) / GROUP_HEIGHT);
}

// Index of the head of the overflow list of this owner. The first invocation that asks for it claims a free list.
// There is always one: there are more lists than the nodes can fill.
fn overflow_head(owner: u32) -> u32 {
    // Fibonacci hashing, by the golden ratio.
    var list = (owner * 2654435769u) >> (32u - OVERFLOW_BITS);
    loop {
        var found = atomicLoad(&list_heads[OWNERS + list]);
        if found == 0u {
            let asked = atomicCompareExchangeWeak(&list_heads[OWNERS + list], 0u, owner);
            // The weak exchange may fail spuriously.
            found = select(asked.old_value, owner, asked.exchanged);
        }
        if found == owner {
            break;
        }
        if found != 0u {
            list = (list + 1u) % OVERFLOWS;
        }
    }
    return OVERFLOW_HEADS + list;
}

// Inserts light at a point into the lists of all groups of pixels that its kernel touches.
fn insert(at: vec2<f32>, kernel: u32, light: vec3<f32>) {
    let reach = reach_of(kernel);
    let low = max(ceil(at - reach - 0.5), vec2(0.0));
    let high = min(floor(at + reach - 0.5), vec2<f32>(camera.size - 1u));
    if any(high < low) {
        return;
    }
    let first = group_of(vec2<u32>(low));
    let last = group_of(vec2<u32>(high));
    let count = last - first + 1u;
    var node = 1u + atomicAdd(&list_heads[0], count.x * count.y);
    let spread_light = light * kernel_factor(kernel);
    var group = first;
    // The loops test for their ends after each iteration: see star_list.wgsl.
    loop {
        group.x = first.x;
        loop {
            if node < CAPACITY {
                let next = atomicExchange(&list_heads[list_head(group, node)], node);
                let entry = Node(spread_light, at - vec2<f32>(first_pixel(group)), kernel, next);
                textureStore(nodes, texel_of(node), packed(entry));
            }
            node++;
            if group.x == last.x {
                break;
            }
            group.x++;
        }
        if group.y == last.y {
            break;
        }
        group.y++;
    }
}

// Distributes the light of a point over the kernels: kernel::spread is the reference.
fn spread(at: vec2<f32>, light: vec3<f32>) {
    let brightest = max(light.r, max(light.g, light.b));
    var left = brightest;
    var kernel = 0u;
    while left > 0.0 {
        let taken = min(left, capacity(kernel));
        insert(at, kernel, light * (taken / brightest));
        left -= taken;
        kernel++;
    }
}

// Draws light in a view direction in the hole frame. Camera::project is the reference.
fn show(direction: vec3<f32>, light: vec3<f32>) {
    let ahead = dot(direction, camera.forward);
    if ahead <= 0.0 {
        return;
    }
    let steps = vec2(dot(direction, camera.right), dot(direction, camera.down));
    let squares = vec2(dot(camera.right, camera.right), dot(camera.down, camera.down));
    let at = steps / (ahead * squares) + 0.5 * vec2<f32>(camera.size);
    // Farther out, no kernel reaches the picture.
    if all(abs(at) < vec2(1e5)) {
        spread(at, light);
    }
}

// Draws the image of a star in this image order: twice the number of windings of the light, plus one if the image
// is on the other side of the hole (stars::images::ImageOrder).
fn draw(star: Star, order: u32) {
    let d = in_hole_frame(star.direction);
    let c = -d.z;
    let p = length(d.xy);
    let side = select(1.0, -1.0, (order & 1u) == 1u);
    let sky_angle = side * angle(c, p) - 6.2831855 * f32(order >> 1u);
    let seen = star_image(sky_angle, p);
    let azimuth = d.xy * (side / max(p, 1e-30));
    let direction = vec3(azimuth * seen.cos_sin.y, -seen.cos_sin.x);
    let light = star.light * (point_share(c, p, order == 0u) * seen.magnification);
    let image = observed(direction, seen_light(light, direction));
    if seen.visible && max(image.light.r, max(image.light.g, image.light.b)) >= MIN_LIGHT {
        show(image.direction, image.light);
    }
}

@compute @workgroup_size(64)
fn list_stars(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < lens.candidates {
        let candidate = candidates[id.x];
        draw(stars[candidate & 0xffffffu], candidate >> 24u);
    } else if id.x - lens.candidates < lens.pieces {
        let piece = pieces[id.x - lens.candidates];
        insert(piece.at, piece.kernel, piece.light);
    }
}
