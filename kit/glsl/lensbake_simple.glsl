// The bending of light by a black hole that does not rotate, for all observers at rest.
//
// lensbake_simple(d, hole, r, atlas) returns the direction on the sky from which the light comes that is seen in
// the direction d, or (0, 0, 0) if the ray ends in the hole: draw it black.
//   d             unit view direction, in any frame
//   hole          unit direction of the hole, in the same frame, for example (0, 0, -1)
//   r             radius of the observer in Schwarzschild radii, above 1; 1e30 for infinity
//   atlas         texture of 64 x 128 texels, R the value (floats), the first row at v = 0, which is the top line
//                 of the file: linear data (no sRGB), no mipmaps, no compression, linear filter, clamped to the
//                 edge
// lensbake_simple_bend returns the bending (deflection angle) in radians. Compute in 32-bit floats: with 16 bits
// (mediump, half) the picture is off by up to 3 pixels and grainy.
//
// Error of the numbers (f16, 64 texels a row) against the closed form: 4.3e-4 rad on the sky, 0.121 pixels of a
// picture 1920 pixels wide and 90 degrees across. These are the largest of 20000 random rays in 64-bit arithmetic;
// 32-bit arithmetic adds up to 5e-4 pixels.
//
// Made by: bake export --to glsl --mode simple --texels 64 --precision f16 --function lensbake_simple
// Part of lensbake. Licence: MIT or Apache-2.0, as you like.

#ifndef LENSBAKE_SIMPLE_INCLUDED
#define LENSBAKE_SIMPLE_INCLUDED

// The edge of the shadow (critical curve), as an observer sees it at the angle theta_c from the direction of the hole.
struct lensbake_simple_ShadowEdge {
    // tan(theta_c/2).
    float tan_half;
    // (5/18) cos(theta_c).
    float log_weight;
};

// The edge of the shadow that the observer at rest at r > 1 sees. It depends on r alone, not on the pixel.
lensbake_simple_ShadowEdge lensbake_simple_shadow_edge(float r) {
    float u = 1.0 / r;
    float cosine = 2.598076211 * (0.6666666667 - u) * sqrt(0.3333333333 + u);
    float sine = 2.598076211 * u * sqrt(max((r - 1.0) / r, 0.0));
    lensbake_simple_ShadowEdge edge;
    edge.tan_half = (cosine >= 0.0 ? sine / (1.0 + cosine) : (1.0 - cosine) / max(sine, 1e-30));
    edge.log_weight = 0.2777777778 * cosine;
    return edge;
}

// The row coordinate above the horizon: the normalised shadow coordinate x = tan(theta_c/2) / tan(theta/2) of the direction
// (cos theta, sin theta) = (c, p)/sqrt (c^2 + p^2), where p >= 0; the vector (c, p) need not be normalised. Very large at theta = 0.
float lensbake_simple_row_coordinate(float c, float p, lensbake_simple_ShadowEdge edge) {
    float size = sqrt(c * c + p * p);
    // cot(theta/2), without the cancellation of size - |c|.
    float adjacent = (c >= 0.0 ? size + c : p);
    float opposite = (c >= 0.0 ? max(p, 1e-30) : size - c);
    return edge.tan_half * (adjacent / opposite);
}

// The position along the row, from d = 1 - x and sqrt x.
float lensbake_simple_row_position(float d, float root) {
    return sqrt(d / (1.0 + root));
}

// The stored value at the position q, from 0 at the edge of the shadow to 1 straight away from the hole, for the
// observer at rest at r: one fetch from the atlas with linear filtering. The centres of texels are at half-integers.
float lensbake_simple_stored_value(float q, float r, highp sampler2D atlas) {
    float row = 127.0 * 0.6366197724 * atan(1.0 / sqrt(max(r - 1.0, 1e-30)));
    float x = (q * 63.0 + 0.5) / 64.0;
    float y = (row + 0.5) / 128.0;
    return textureLod(atlas, vec2(x, y), 0.0).x;
}

// The bending (deflection angle) in rad of the light that is seen at the angle theta from the direction of the hole,
// with cos(theta) = c and sin(theta) = p. It comes from the angle theta - bend. 1e4 if the ray ends in the hole.
float lensbake_simple_bend(float c, float p, lensbake_simple_ShadowEdge edge, float r, highp sampler2D atlas) {
    float x = lensbake_simple_row_coordinate(c, p, edge);
    if (x >= 1.0) {
        return 1e4;
    }
    float d = 1.0 - x;
    float stored = lensbake_simple_stored_value(lensbake_simple_row_position(d, sqrt(x)), r, atlas);
    return stored - (1.0 + edge.log_weight * d) * log(d);
}

// (cos, sin) of an angle in rad, to 1e-7 up to 100 turns. The built-in pair need only be good to
// 5e-4 on a Vulkan device, which is half a pixel.
vec2 lensbake_simple_cos_sin(float angle) {
    float quarter = round(angle * 0.63661975);
    // pi/2 in three parts, the products of the first two exact: a device need not fuse an fma.
    float r = ((angle - quarter * 1.5703125) - quarter * 4.837513e-4) - quarter * 7.54979e-8;
    float r2 = r * r;
    float sine = r + r * r2 * (-1.6666654e-1 + r2 * (8.332161e-3 + r2 * -1.9515296e-4));
    float cosine = 1.0 - 0.5 * r2 + r2 * r2 * (4.1666646e-2 + r2 * (-1.3887316e-3 + r2 * 2.4433157e-5));
    int turn = int(quarter) & 3;
    vec2 swapped = ((turn & 1) == 1 ? vec2(sine, cosine) : vec2(cosine, sine));
    return vec2(
        (turn == 1 || turn == 2 ? -swapped.x : swapped.x),
        (turn >= 2 ? -swapped.y : swapped.y)
    );
}

// (cos theta', sin theta') of the direction turned towards the hole by the bending Delta: theta' = theta - Delta. It has the length of (c, p).
vec2 lensbake_simple_turned(float c, float p, float bend) {
    vec2 t = lensbake_simple_cos_sin(bend);
    return vec2(c * t.x + p * t.y, p * t.x - c * t.y);
}

// The direction on the sky from which the light comes that is seen in the direction d; hole is the direction of the hole.
// All are unit vectors in any one frame. (0, 0, 0) if the ray ends in the hole.
vec3 lensbake_simple(vec3 d, vec3 hole, float r, highp sampler2D atlas) {
    // (x, y, z) is the part of d across the direction of the hole, found from the difference of the two directions, which
    // is exact where they are close: the shadow of a distant hole is small.
    float side = (d.x * hole.x + d.y * hole.y + d.z * hole.z >= 0.0 ? 1.0 : -1.0);
    float off_x = d.x - side * hole.x;
    float off_y = d.y - side * hole.y;
    float off_z = d.z - side * hole.z;
    float along = off_x * hole.x + off_y * hole.y + off_z * hole.z;
    float x = off_x - along * hole.x;
    float y = off_y - along * hole.y;
    float z = off_z - along * hole.z;
    float p = sqrt(x * x + y * y + z * z);
    float c = side + along;
    float angle = lensbake_simple_bend(c, p, lensbake_simple_shadow_edge(r), r, atlas);
    if (angle > 1e3) {
        return vec3(0.0, 0.0, 0.0);
    }
    vec2 sky = lensbake_simple_turned(c, p, angle);
    float across = sky.y / max(p, 1e-30);
    return vec3(
        sky.x * hole.x + across * x,
        sky.x * hole.y + across * y,
        sky.x * hole.z + across * z
    );
}

#endif
