// Sorts the images of the stars into lists by tile of the picture, for star_light.wgsl to read. One
// invocation a star, then one a piece of an arc. Twin of stars/draw.rs.

struct Lens {
    // The distance from the axis up to which a star is drawn as arcs alone, rad.
    point_distance: f32,
    stars: u32,
    pieces: u32,
    @align(16) inverse: Inverse,
}

struct Star {
    // In the sky frame.
    direction: vec3<f32>,
    light: vec3<f32>,
}

// A piece of an arc: light at a point of the picture.
struct Piece {
    at: vec2<f32>,
    reach: f32,
    light: vec3<f32>,
}

// Of star_light.wgsl.
struct Node {
    at: vec2<f32>,
    reach: f32,
    next: u32,
    light: vec3<f32>,
}

@group(0) @binding(2) var<uniform> lens: Lens;
@group(0) @binding(3) var<storage, read> stars: array<Star>;
@group(0) @binding(4) var<storage, read> pieces: array<Piece>;
@group(0) @binding(5) var<storage, read_write> heads: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> nodes: array<Node>;

struct StarImage {
    visible: bool,
    // (cos θ, sin θ).
    cos_sin: vec2<f32>,
    magnification: f32,
}

// Puts light at a point into the lists of the tiles that its kernel touches.
fn insert(at: vec2<f32>, reach: f32, light: vec3<f32>) {
    let last = vec2<f32>(frame.size - 1u);
    let low = max(ceil(at - reach - 0.5), vec2(0.0));
    let high = min(floor(at + reach - 0.5), last);
    if any(high < low) {
        return;
    }
    let across = (frame.size.x + STAR_TILE - 1u) / STAR_TILE;
    let first = vec2<u32>(low) / STAR_TILE;
    let end = vec2<u32>(high) / STAR_TILE;
    for (var y = first.y; y <= end.y; y++) {
        for (var x = first.x; x <= end.x; x++) {
            let index = atomicAdd(&heads[0], 1u);
            if index < arrayLength(&nodes) {
                let next = atomicExchange(&heads[1u + y * across + x], index + 1u);
                nodes[index] = Node(at, reach, next, light);
            }
        }
    }
}

// Spreads the light of a point over the kernels. Twin of kernel::spread.
fn spread(at: vec2<f32>, light: vec3<f32>) {
    let brightest = max(light.r, max(light.g, light.b));
    var left = brightest;
    var reach = CORE;
    while left > 0.0 {
        let taken = min(left, capacity(reach));
        insert(at, reach, light * (taken / brightest));
        left -= taken;
        reach = select(2.0 * reach, FIRST_HALO, reach == CORE);
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

// Draws a star's images.
fn draw(star: Star) {
    let d = vec3(dot(frame.sky_x, star.direction), dot(frame.sky_y, star.direction), dot(frame.sky_z, star.direction));
    let c = -d.z;
    let p = length(d.xy);
    let beta = angle(c, p);
    let azimuth = d.xy / max(p, 1e-30);
    for (var windings = 0u; windings <= MAX_WINDINGS; windings++) {
        var bright = false;
        for (var side = 1.0; side >= -1.0; side -= 2.0) {
            let share = point_share(c, p, windings == 0u && side > 0.0);
            if share <= 0.0 {
                continue;
            }
            let seen = star_image(side * beta - 6.2831855 * f32(windings), p);
            let light = star.light * (share * seen.magnification);
            if seen.visible && max(light.r, max(light.g, light.b)) >= FAINTEST {
                bright = true;
                show(vec3(azimuth * (side * seen.cos_sin.y), -seen.cos_sin.x), light);
            }
        }
        if !bright {
            break;
        }
    }
}

@compute @workgroup_size(64)
fn sort_stars(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < lens.stars {
        draw(stars[id.x]);
    } else if id.x - lens.stars < lens.pieces {
        let piece = pieces[id.x - lens.stars];
        insert(piece.at, piece.reach, piece.light);
    }
}
