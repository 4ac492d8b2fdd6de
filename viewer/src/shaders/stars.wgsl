// Puts the light of the stars into lists for star_light.wgsl to add up. One invocation
// an image of a star, then one a piece of an arc. Twin of stars/draw.rs.

struct Lens {
    // The distance from the axis up to which a star is drawn as arcs alone, rad.
    point_distance: f32,
    candidates: u32,
    pieces: u32,
    @align(16) inverse: Inverse,
    // Of the inverse row: two in each.
    @align(16) texels: array<vec4<f32>, INVERSE_PAIRS>,
}

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

@group(0) @binding(1) var<uniform> lens: Lens;
@group(0) @binding(2) var<storage, read> stars: array<Star>;
@group(0) @binding(3) var<storage, read> pieces: array<Piece>;
// The images that the picture may show: the index of the star, and from bit 24 on the way of its light.
@group(0) @binding(4) var<storage, read> candidates: array<u32>;
@group(0) @binding(5) var<storage, read_write> heads: array<atomic<u32>>;
@group(0) @binding(6) var nodes: texture_storage_2d<rgba32uint, write>;

fn inverse_texel(i: u32) -> vec2<f32> {
    let pair = lens.texels[i / 2u];
    return select(pair.xy, pair.zw, (i & 1u) == 1u);
}

struct StarImage {
    visible: bool,
    // (cos θ, sin θ).
    cos_sin: vec2<f32>,
    magnification: f32,
}

// Where the list of a group begins that takes this place.
fn list_of(group: vec2<u32>, place: u32) -> u32 {
    let index = index_of(group);
    if place < UNCOUNTED {
        return head_of(index);
    }
    let full = atomicAdd(&heads[head_of(groups()) + index / 2u], 1u) / LIST;
    if full == 0u {
        return head_of(index);
    }
    return overflow_list((index + 1u) * A_GROUP + full);
}

fn groups() -> u32 {
    return groups_across() * ((frame.size.y + SHARING_Y - 1u) / SHARING_Y);
}

// Where the overflow list of this owner begins. The first who asks takes one that is nobody's: there are more of
// them than places for.
fn overflow_list(owner: u32) -> u32 {
    // Spread by the golden ratio.
    var list = (owner * 2654435769u) >> (32u - OVERFLOW_BITS);
    loop {
        var found = atomicLoad(&heads[OWNERS + list]);
        if found == 0u {
            let asked = atomicCompareExchangeWeak(&heads[OWNERS + list], 0u, owner);
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

// Puts light at a point into the lists of the groups of pixels that its kernel touches.
fn insert(at: vec2<f32>, kernel: u32, light: vec3<f32>) {
    let reach = reach_of(kernel);
    let low = max(ceil(at - reach - 0.5), vec2(0.0));
    let high = min(floor(at + reach - 0.5), vec2<f32>(frame.size - 1u));
    if any(high < low) {
        return;
    }
    let first = group_of(vec2<u32>(low));
    let last = group_of(vec2<u32>(high));
    let count = last - first + 1u;
    var place = 1u + atomicAdd(&heads[0], count.x * count.y);
    let spread_light = light * kernel_factor(kernel);
    var group = first;
    // The ends are looked for after each turn: see star_light.wgsl.
    loop {
        group.x = first.x;
        loop {
            if place < ROOM {
                let next = atomicExchange(&heads[list_of(group, place)], place);
                let node = Node(spread_light, at - vec2<f32>(first_pixel(group)), kernel, next);
                textureStore(nodes, texel_of(place), packed(node));
            }
            place++;
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

// Spreads the light of a point over the kernels. Twin of kernel::spread.
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

// Draws what is seen in a direction of the hole frame. Twin of Camera::position.
fn show(direction: vec3<f32>, light: vec3<f32>) {
    let ahead = dot(direction, frame.forward);
    if ahead <= 0.0 {
        return;
    }
    let steps = vec2(dot(direction, frame.right), dot(direction, frame.down));
    let squares = vec2(dot(frame.right, frame.right), dot(frame.down, frame.down));
    let at = steps / (ahead * squares) + 0.5 * vec2<f32>(frame.size);
    // So far out no kernel reaches the picture.
    if all(abs(at) < vec2(1e5)) {
        spread(at, light);
    }
}

// Draws the image of a star by one of the ways that its light takes: twice the number of further turns,
// and one more if it is seen on the other side. Twin of Way.
fn draw(star: Star, way: u32) {
    let d = vec3(dot(frame.sky_x, star.direction), dot(frame.sky_y, star.direction), dot(frame.sky_z, star.direction));
    let c = -d.z;
    let p = length(d.xy);
    let side = select(1.0, -1.0, (way & 1u) == 1u);
    let sky_angle = side * angle(c, p) - 6.2831855 * f32(way >> 1u);
    let seen = star_image(sky_angle, p);
    let light = star.light * (point_share(c, p, way == 0u) * seen.magnification);
    if seen.visible && max(light.r, max(light.g, light.b)) >= FAINTEST {
        let azimuth = d.xy * (side / max(p, 1e-30));
        show(vec3(azimuth * seen.cos_sin.y, -seen.cos_sin.x), light);
    }
}

@compute @workgroup_size(64)
fn sort_stars(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < lens.candidates {
        let candidate = candidates[id.x];
        draw(stars[candidate & 0xffffffu], candidate >> 24u);
    } else if id.x - lens.candidates < lens.pieces {
        let piece = pieces[id.x - lens.candidates];
        insert(piece.at, piece.kernel, piece.light);
    }
}
