// The bending of light by a black hole that does not rotate, for all observers at rest.
//
// lensbake(d, hole, r, row) returns the direction on the sky from which the light comes that is seen in the
// direction d, or (0, 0, 0) if the ray ends in the hole: draw it black.
//   d             unit view direction, in any frame
//   hole          unit direction of the hole, in the same frame, for example (0, 0, -1)
//   r             radius of the observer in Schwarzschild radii, above 1; 1e30 for infinity
//   row           texture of 64 x 1 texels in 32-bit floats, R the value and G the slope: the row of the observer,
//                 mixed from the rows of the atlas by the caller when r changes. Texels are loaded, not filtered
// lensbake_bend returns the bending (deflection angle) in radians. Compute in 32-bit floats: with 16 bits
// (mediump, half) the picture is off by up to 3 pixels and grainy.
//
// Error of the numbers (f32, 64 texels a row) against the closed form: 5.9e-8 rad on the sky, 2.1e-5 pixels of a
// picture 1920 pixels wide and 90 degrees across. These are the largest of 20000 random rays in 64-bit arithmetic;
// 32-bit arithmetic adds up to 5e-4 pixels.
//
// Made by: bake export --to hlsl --mode row --texels 64 --precision f32
// Part of lensbake. Licence: MIT or Apache-2.0, as you like.

#ifndef LENSBAKE_INCLUDED
#define LENSBAKE_INCLUDED

// The edge of the shadow (critical curve), as an observer sees it at the angle theta_c from the direction of the hole.
struct lensbake_ShadowEdge {
    // tan(theta_c/2).
    float tan_half;
    // (5/18) cos(theta_c).
    float log_weight;
};

// The edge of the shadow that the observer at rest at r > 1 sees. It depends on r alone, not on the pixel.
lensbake_ShadowEdge lensbake_shadow_edge(float r) {
    float u = 1.0 / r;
    float cosine = 2.598076211 * (0.6666666667 - u) * sqrt(0.3333333333 + u);
    float sine = 2.598076211 * u * sqrt(max((r - 1.0) / r, 0.0));
    lensbake_ShadowEdge edge;
    edge.tan_half = (cosine >= 0.0 ? sine / (1.0 + cosine) : (1.0 - cosine) / max(sine, 1e-30));
    edge.log_weight = 0.2777777778 * cosine;
    return edge;
}

// The row coordinate above the horizon: the normalised shadow coordinate x = tan(theta_c/2) / tan(theta/2) of the direction
// (cos theta, sin theta) = (c, p)/sqrt (c^2 + p^2), where p >= 0; the vector (c, p) need not be normalised. Very large at theta = 0.
float lensbake_row_coordinate(float c, float p, lensbake_ShadowEdge edge) {
    float size = sqrt(c * c + p * p);
    // cot(theta/2), without the cancellation of size - |c|.
    float adjacent = (c >= 0.0 ? size + c : p);
    float opposite = (c >= 0.0 ? max(p, 1e-30) : size - c);
    return edge.tan_half * (adjacent / opposite);
}

// The position along the row, from d = 1 - x and sqrt x.
float lensbake_row_position(float d, float root) {
    return sqrt(d / (1.0 + root));
}

// Cubic Hermite interpolation between the values a.x and slopes a.y (at t = 0) and the values b.x and slopes b.y
// (at t = 1): the value and its derivative at t.
float2 lensbake_cubic(float2 a, float2 b, float t) {
    float rise = b.x - a.x;
    float c2 = 3.0 * rise - 2.0 * a.y - b.y;
    float c3 = a.y + b.y - 2.0 * rise;
    return float2(a.x + t * (a.y + t * (c2 + t * c3)), a.y + t * (2.0 * c2 + t * 3.0 * c3));
}

// Texel i of the row: the stored value and its slope per texel.
float2 lensbake_texel(int i, Texture2D row) {
    float2 stored = row.Load(int3(i, 0, 0)).xy;
    return float2(stored.x, stored.y);
}

// The stored value at the position q, from 0 at the edge of the shadow to 1 straight away from the hole.
float lensbake_stored_value(float q, Texture2D row) {
    float position = q * 63.0;
    int i = int(min(position, 62.0));
    float2 a = lensbake_texel(i, row);
    float2 b = lensbake_texel(i + 1, row);
    float2 mixed = lensbake_cubic(a, b, position - float(i));
    return mixed.x;
}

// The bending (deflection angle) in rad of the light that is seen at the angle theta from the direction of the hole,
// with cos(theta) = c and sin(theta) = p. It comes from the angle theta - bend. 1e4 if the ray ends in the hole.
float lensbake_bend(float c, float p, lensbake_ShadowEdge edge, Texture2D row) {
    float x = lensbake_row_coordinate(c, p, edge);
    if (x >= 1.0) {
        return 1e4;
    }
    float d = 1.0 - x;
    float stored = lensbake_stored_value(lensbake_row_position(d, sqrt(x)), row);
    return stored - (1.0 + edge.log_weight * d) * log(d);
}

// (cos, sin) of an angle in rad, to 1e-7 up to 100 turns. The built-in pair need only be good to
// 5e-4 on a Vulkan device, which is half a pixel.
float2 lensbake_cos_sin(float angle) {
    float quarter = round(angle * 0.63661975);
    // pi/2 in three parts, the products of the first two exact: a device need not fuse an fma.
    float r = ((angle - quarter * 1.5703125) - quarter * 4.837513e-4) - quarter * 7.54979e-8;
    float r2 = r * r;
    float sine = r + r * r2 * (-1.6666654e-1 + r2 * (8.332161e-3 + r2 * -1.9515296e-4));
    float cosine = 1.0 - 0.5 * r2 + r2 * r2 * (4.1666646e-2 + r2 * (-1.3887316e-3 + r2 * 2.4433157e-5));
    int turn = int(quarter) & 3;
    float2 swapped = ((turn & 1) == 1 ? float2(sine, cosine) : float2(cosine, sine));
    return float2(
        (turn == 1 || turn == 2 ? -swapped.x : swapped.x),
        (turn >= 2 ? -swapped.y : swapped.y)
    );
}

// (cos theta', sin theta') of the direction turned towards the hole by the bending Delta: theta' = theta - Delta. It has the length of (c, p).
float2 lensbake_turned(float c, float p, float bend) {
    float2 t = lensbake_cos_sin(bend);
    return float2(c * t.x + p * t.y, p * t.x - c * t.y);
}

// The direction on the sky from which the light comes that is seen in the direction d; hole is the direction of the hole.
// All are unit vectors in any one frame. (0, 0, 0) if the ray ends in the hole.
float3 lensbake(float3 d, float3 hole, float r, Texture2D row) {
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
    float angle = lensbake_bend(c, p, lensbake_shadow_edge(r), row);
    if (angle > 1e3) {
        return float3(0.0, 0.0, 0.0);
    }
    float2 sky = lensbake_turned(c, p, angle);
    float across = sky.y / max(p, 1e-30);
    return float3(
        sky.x * hole.x + across * x,
        sky.x * hole.y + across * y,
        sky.x * hole.z + across * z
    );
}

#endif
