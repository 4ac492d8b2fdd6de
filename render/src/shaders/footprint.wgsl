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
    let derivative = deflected.radial;
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

// The axes of a footprint on the face of a cube: their squared lengths in texels, and the longer one as a step across the
// sky, rad.
struct Axes {
    long_sq: f32,
    short_sq: f32,
    long: vec3<f32>,
}

// Whether the sky is magnified over a footprint, so that one bilinear tap is its mean.
fn is_magnified(print: Footprint, face_texels: f32) -> bool {
    let size = abs(print.d);
    let depth = max(size.x, max(size.y, size.z));
    let density = 0.5 * face_texels / (depth * depth);
    let bound = (dot(print.right, print.right) + dot(print.down, print.down)) * density * density;
    return bound < ONE_TAP_SQ;
}

// The component of v along the axis of the face that has the largest of the components `size`.
fn along_axis(v: vec3<f32>, size: vec3<f32>) -> f32 {
    let of_sides = select(v.x, v.y, size.y >= size.x);
    return select(of_sides, v.z, size.z >= max(size.x, size.y));
}

// The axes of a footprint in the frame of the cube. A step s of the unit direction d is the step s − d s_a/d_a along the
// face with the axis a, times texels/(2 |d_a|); with s·d = 0, products of two such steps s and t are s·t + s_a t_a/d_a².
fn axes_of(print: Footprint, face_texels: f32) -> Axes {
    let size = abs(print.d);
    let inverse = 1.0 / max(size.x, max(size.y, size.z));
    let density = 0.5 * face_texels * inverse;
    let density_sq = density * density;
    let right_a = along_axis(print.right, size) * inverse;
    let down_a = along_axis(print.down, size) * inverse;
    // The axes of the footprint's ellipse are the eigenvectors of the Gram matrix of the two steps.
    let rr = density_sq * (dot(print.right, print.right) + right_a * right_a);
    let dd = density_sq * (dot(print.down, print.down) + down_a * down_a);
    let rd = density_sq * (dot(print.right, print.down) + right_a * down_a);
    let half = 0.5 * (rr - dd);
    let root = sqrt(half * half + rd * rd);
    let long_sq = 0.5 * (rr + dd) + root;
    let area = cross(print.right, print.down) * (density_sq * inverse);
    let product = select(vec2(rd, root - half), vec2(half + root, rd), half >= 0.0);
    let product_sq = dot(product, product);
    let long_axis = select(vec2(1.0, 0.0), product * inverseSqrt(product_sq), product_sq > 0.0);
    return Axes(
        long_sq,
        dot(area, area) / long_sq,
        print.right * long_axis.x + print.down * long_axis.y,
    );
}

// The number of taps of a row in the first level, and the step from one to the next.
struct RowOfTaps {
    count: f32,
    step: vec3<f32>,
}

// The taps of a footprint whose taps are all in the first level: as `taps`.
fn first_level_taps(print: Footprint, face_texels: f32) -> RowOfTaps {
    let axes = axes_of(print, face_texels);
    let length_sq = max(axes.long_sq - 1.0, 0.0);
    let count = clamp(ceil(sqrt(length_sq) / SPACING), 1.0, MAX_TAPS);
    let spread = sqrt(length_sq / (max(count * count - 1.0, 1.0) * axes.long_sq));
    return RowOfTaps(count, axes.long * spread);
}

// At most `most` taps that average the cube map over a footprint, in the frame of the cube.
fn taps(print: Footprint, face_texels: f32, most: f32) -> Taps {
    if is_magnified(print, face_texels) {
        return Taps(0.0, 1.0, vec3(0.0), 0.0);
    }
    let axes = axes_of(print, face_texels);
    var long_sq = axes.long_sq;
    let short_sq = axes.short_sq;
    let length_of_arc = length(axes.long);
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
        axes.long / length_of_arc,
        spread * length_of_arc * round_sky,
    );
}
