// The patch of sky that a patch of the picture covers, and how to average over it. Twin of footprint.rs,
// which derives the formulae.

// Distance of two taps at the most, in texels of their level.
const SPACING: f32 = 1.5;
// A footprint of less than this squared length in texels is one bilinear tap.
const ONE_TAP_SQ: f32 = 2.5;
const TURN: f32 = 6.2831855;

// A patch of the picture: its unit view direction in the hole frame with cos θ = c and sin θ = p, the
// unit vectors along which θ grows and about the hole, and what its sides change along these, rad.
struct Patch {
    d: vec3<f32>,
    c: f32,
    p: f32,
    away: vec3<f32>,
    about: vec3<f32>,
    right: vec2<f32>,
    down: vec2<f32>,
}

// A patch of the sky: its unit direction, and what its sides change, rad.
struct Footprint {
    d: vec3<f32>,
    right: vec3<f32>,
    down: vec3<f32>,
}

// Taps on an arc of a great circle: their level and number, the unit vector along the arc in its middle
// and the angle from one to the next.
struct Taps {
    level: f32,
    count: f32,
    along: vec3<f32>,
    step: f32,
}

// The patch about `ray` with the sides `right` and `down`, none of them normalised.
fn patch_of(ray: vec3<f32>, right: vec3<f32>, down: vec3<f32>) -> Patch {
    let inverse = inverseSqrt(dot(ray, ray));
    let d = ray * inverse;
    let p = length(d.xy);
    let radius = select(vec2(1.0, 0.0), d.xy / p, p > 0.0);
    let away = vec3(radius * -d.z, p);
    let about = vec3(-radius.y, radius.x, 0.0);
    return Patch(
        d, -d.z, p, away, about,
        vec2(dot(right, away), dot(right, about)) * inverse,
        vec2(dot(down, away), dot(down, about)) * inverse,
    );
}

// |dθ| over the side of the patch along which θ grows, rad.
fn gradient(seen: Patch) -> f32 {
    return length(vec2(seen.right.x, seen.down.x));
}

// The patch moved by `angle` away from the hole, its length along the radius times `extent`.
fn moved(seen: Patch, angle: f32, extent: f32) -> Patch {
    return patch_of(
        seen.d + seen.away * angle,
        seen.away * (seen.right.x * extent) + seen.about * seen.right.y,
        seen.away * (seen.down.x * extent) + seen.about * seen.down.y,
    );
}

// The patch of the sky that a patch covers after the hole has turned it.
fn footprint(seen: Patch, turned: Turned) -> Footprint {
    let stretch = 1.0 - turned.slope;
    let radius = vec2(seen.about.y, -seen.about.x);
    let away = vec3(radius * turned.cos_sky, turned.sin_sky) * stretch;
    // On the axis, where sin θ is 0, both stretches are the same.
    let about = seen.about * select(stretch, turned.sin_sky / seen.p, seen.p > 0.0);
    return Footprint(
        turn_direction(seen.d, seen.p, turned),
        away * seen.right.x + about * seen.right.y,
        away * seen.down.x + about * seen.down.y,
    );
}

// What the small change `step` of a direction d is on the cube's face with this axis, in texels.
fn texels_on_face(step: vec3<f32>, d: vec3<f32>, axis: vec3<f32>, face_texels: f32) -> vec3<f32> {
    let inverse = 1.0 / dot(d, axis);
    return (step - d * (dot(step, axis) * inverse)) * (abs(inverse) * 0.5 * face_texels);
}

// At most `most` taps that average the cube map over a footprint, in the frame of the cube.
fn taps(print: Footprint, face_texels: f32, most: f32) -> Taps {
    let size = abs(print.d);
    let depth = max(size.x, max(size.y, size.z));
    let density = 0.5 * face_texels / (depth * depth);
    let bound = (dot(print.right, print.right) + dot(print.down, print.down)) * density * density;
    if bound < ONE_TAP_SQ {
        return Taps(0.0, 1.0, vec3(0.0), 0.0);
    }
    var axis = select(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), size.y >= size.x);
    axis = select(axis, vec3(0.0, 0.0, 1.0), size.z >= max(size.x, size.y));
    let right = texels_on_face(print.right, print.d, axis, face_texels);
    let down = texels_on_face(print.down, print.d, axis, face_texels);
    // The axes of the ellipse are those of the matrix of products of both.
    let rr = dot(right, right);
    let dd = dot(down, down);
    let rd = dot(right, down);
    let half = 0.5 * (rr - dd);
    let root = length(vec2(half, rd));
    var long_sq = 0.5 * (rr + dd) + root;
    let normal = cross(right, down);
    let short_sq = dot(normal, normal) / long_sq;
    let product = select(vec2(rd, root - half), vec2(half + root, rd), half >= 0.0);
    let long_axis = select(vec2(1.0, 0.0), normalize(product), root > 0.0);
    let arc = print.right * long_axis.x + print.down * long_axis.y;
    let length_of_arc = length(arc);
    // Once round the sky is all of it.
    let round_sky = min(TURN / length_of_arc, 1.0);
    long_sq *= round_sky * round_sky;

    let reach = SPACING * most;
    let texels_sq = clamp(
        max((short_sq + 2.0) / 3.0, long_sq / (reach * reach)),
        1.0,
        face_texels * face_texels,
    );
    let length_sq = max(long_sq + 2.0 - 3.0 * texels_sq, 0.0);
    let count = clamp(ceil(sqrt(length_sq / texels_sq) / SPACING), 1.0, most);
    // n points a step s apart spread as a row of the length s √(n² − 1).
    let spread = sqrt(length_sq / (max(count * count - 1.0, 1.0) * long_sq));
    return Taps(
        0.5 * log2(texels_sq),
        count,
        arc / length_of_arc,
        spread * length_of_arc * round_sky,
    );
}
