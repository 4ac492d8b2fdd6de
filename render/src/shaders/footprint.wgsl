// The footprint, which is the patch of sky that a patch of the picture covers, and the anisotropic filter that
// averages over it. footprint.rs derives the formulae and is the reference in f64.
// #import constants
// #import deflection
// #import patch

const FULL_TURN: f32 = 6.2831855;

// A patch of the sky: the unit direction of its centre, and the steps across it to the right and downwards, rad.
struct Footprint {
    d: vec3<f32>,
    right: vec3<f32>,
    down: vec3<f32>,
}

// Evenly spaced taps on an arc of a great circle: their mip level and number, the unit tangent of the arc at its
// middle, and the angle between neighbouring taps, rad.
struct Taps {
    level: f32,
    count: f32,
    along: vec3<f32>,
    step: f32,
}

// The footprint of a patch: the patch of sky that it covers after deflection.
fn footprint(seen: Patch, deflected: Deflected) -> Footprint {
    let derivative = 1.0 - deflected.slope;
    let radius = vec2(seen.tangential.y, -seen.tangential.x);
    let radial = vec3(radius * deflected.cos_sky, deflected.sin_sky) * derivative;
    // On the axis, where sin θ is 0, both derivatives are equal.
    let tangential = seen.tangential * select(derivative, deflected.sin_sky / seen.p, seen.p > 0.0);
    return Footprint(
        turn_direction(seen.d, seen.p, deflected),
        radial * seen.right.x + tangential * seen.right.y,
        radial * seen.down.x + tangential * seen.down.y,
    );
}

// The small change `step` of a direction d, projected onto the cube face with this axis, in texels.
fn texels_on_face(step: vec3<f32>, d: vec3<f32>, axis: vec3<f32>, face_texels: f32) -> vec3<f32> {
    let inverse = 1.0 / dot(d, axis);
    return (step - d * (dot(step, axis) * inverse)) * (abs(inverse) * 0.5 * face_texels);
}

// Whether the sky is magnified over a footprint, so that one bilinear tap is its mean.
fn is_magnified(print: Footprint, face_texels: f32) -> bool {
    let size = abs(print.d);
    let depth = max(size.x, max(size.y, size.z));
    let density = 0.5 * face_texels / (depth * depth);
    let bound = (dot(print.right, print.right) + dot(print.down, print.down)) * density * density;
    return bound < ONE_TAP_SQ;
}

// At most `most` taps that average the cube map over a footprint, in the frame of the cube.
fn taps(print: Footprint, face_texels: f32, most: f32) -> Taps {
    if is_magnified(print, face_texels) {
        return Taps(0.0, 1.0, vec3(0.0), 0.0);
    }
    let size = abs(print.d);
    var axis = select(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), size.y >= size.x);
    axis = select(axis, vec3(0.0, 0.0, 1.0), size.z >= max(size.x, size.y));
    let right = texels_on_face(print.right, print.d, axis, face_texels);
    let down = texels_on_face(print.down, print.d, axis, face_texels);
    // The axes of the footprint's ellipse are the eigenvectors of the Gram matrix of the two steps.
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
    // Clamp the arc to 2π.
    let round_sky = min(FULL_TURN / length_of_arc, 1.0);
    long_sq *= round_sky * round_sky;

    let reach = SPACING * most;
    let texels_sq = clamp(
        max((short_sq + 2.0) / 3.0, long_sq / (reach * reach)),
        1.0,
        face_texels * face_texels,
    );
    let length_sq = max(long_sq + 2.0 - 3.0 * texels_sq, 0.0);
    let count = clamp(ceil(sqrt(length_sq / texels_sq) / SPACING), 1.0, most);
    // n points at spacing s have the variance of a row of length s √(n² − 1).
    let spread = sqrt(length_sq / (max(count * count - 1.0, 1.0) * long_sq));
    return Taps(
        0.5 * log2(texels_sq),
        count,
        arc / length_of_arc,
        spread * length_of_arc * round_sky,
    );
}
