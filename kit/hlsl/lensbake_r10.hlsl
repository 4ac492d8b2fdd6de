// The bending of light by a black hole that does not rotate, for the observer at rest at r = 10 Schwarzschild
// radii.
//
// lensbake_r10(d, hole) returns the direction on the sky from which the light comes that is seen in the direction
// d, or (0, 0, 0) if the ray ends in the hole: draw it black.
//   d             unit view direction, in any frame
//   hole          unit direction of the hole, in the same frame, for example (0, 0, -1)
// lensbake_r10_bend returns the bending (deflection angle) in radians. Compute in 32-bit floats: with 16 bits
// (mediump, half) the picture is off by up to 3 pixels and grainy.
//
// Error of the numbers (f32, 64 texels a row) against the closed form: 2.3e-8 rad on the sky, 2.1e-5 pixels of a
// picture 1920 pixels wide and 90 degrees across. These are the largest of 20000 random rays in 64-bit arithmetic;
// 32-bit arithmetic adds up to 5e-4 pixels.
//
// Made by: bake export --to hlsl --observer 10 --texels 64 --precision f32 --function lensbake_r10
// Part of lensbake. Licence: MIT or Apache-2.0, as you like.

#ifndef LENSBAKE_R10_INCLUDED
#define LENSBAKE_R10_INCLUDED

// Value and slope of each texel.
static const float lensbake_r10_numbers[128] = {
    -0.38244042, 0.0, -0.38233608, 0.0002091851, -0.38202044, 0.0004231249, -0.38148737, 0.0006443936,
    -0.3807287, 0.00087459706, -0.37973487, 0.0011147604, -0.37849563, 0.001365481, -0.3770003, 0.0016270288,
    -0.37523797, 0.0018994118, -0.3731979, 0.0021824178, -0.37086973, 0.0024756505, -0.3682434, 0.0027785543,
    -0.36530963, 0.0030904359, -0.3620598, 0.0034104818, -0.35848624, 0.0037377726, -0.3545822, 0.004071295,
    -0.35034195, 0.0044099516, -0.34576094, 0.0047525717, -0.34083587, 0.0050979177, -0.33556464, 0.0054446915,
    -0.32994646, 0.005791543, -0.323982, 0.0061370726, -0.31767324, 0.0064798393, -0.31102374, 0.0068183634,
    -0.30403844, 0.007151129, -0.2967239, 0.0074765924, -0.28908822, 0.00779318, -0.28114104, 0.008099295,
    -0.27289367, 0.008393318, -0.26435897, 0.008673613, -0.25555155, 0.008938523, -0.24648762, 0.00918638,
    -0.23718505, 0.009415499, -0.22766343, 0.009624189, -0.21794404, 0.009810742, -0.2080499, 0.009973445,
    -0.19800568, 0.010110576, -0.18783784, 0.010220404, -0.17757455, 0.010301191, -0.16724572, 0.010351193,
    -0.156883, 0.010368663, -0.14651982, 0.010351848, -0.13619132, 0.010299, -0.12593442, 0.010208378,
    -0.11578773, 0.0100782635, -0.10579161, 0.009906983, -0.09598802, 0.009692939, -0.08642048, 0.009434665,
    -0.077133864, 0.009130903, -0.06817415, 0.008780717, -0.059588064, 0.0083836485, -0.05142243, 0.007939897,
    -0.043723483, 0.0074505326, -0.036535874, 0.0069176736, -0.029901564, 0.0063445666, -0.023858743, 0.0057354807,
    -0.01844095, 0.0050953566, -0.013676696, 0.00442921, -0.009589744, 0.003741376, -0.006200183, 0.003034754,
    -0.0035261912, 0.0023101831, -0.0015863065, 0.0015660571, -0.0004019607, 0.00079819845, 0.0, 0.0
};

// The edge of the shadow (critical curve), as an observer sees it at the angle theta_c from the direction of the hole.
struct lensbake_r10_ShadowEdge {
    // tan(theta_c/2).
    float tan_half;
    // (5/18) cos(theta_c).
    float log_weight;
};

// The edge of the shadow that the observer of this row sees.
lensbake_r10_ShadowEdge lensbake_r10_shadow_edge() {
    lensbake_r10_ShadowEdge edge;
    edge.tan_half = 0.12516835;
    edge.log_weight = 0.26920807;
    return edge;
}

// The row coordinate above the horizon: the normalised shadow coordinate x = tan(theta_c/2) / tan(theta/2) of the direction
// (cos theta, sin theta) = (c, p)/sqrt (c^2 + p^2), where p >= 0; the vector (c, p) need not be normalised. Very large at theta = 0.
float lensbake_r10_row_coordinate(float c, float p, lensbake_r10_ShadowEdge edge) {
    float size = sqrt(c * c + p * p);
    // cot(theta/2), without the cancellation of size - |c|.
    float adjacent = (c >= 0.0 ? size + c : p);
    float opposite = (c >= 0.0 ? max(p, 1e-30) : size - c);
    return edge.tan_half * (adjacent / opposite);
}

// The position along the row, from d = 1 - x and sqrt x.
float lensbake_r10_row_position(float d, float root) {
    return sqrt(d / (1.0 + root));
}

// Cubic Hermite interpolation between the values a.x and slopes a.y (at t = 0) and the values b.x and slopes b.y
// (at t = 1): the value and its derivative at t.
float2 lensbake_r10_cubic(float2 a, float2 b, float t) {
    float rise = b.x - a.x;
    float c2 = 3.0 * rise - 2.0 * a.y - b.y;
    float c3 = a.y + b.y - 2.0 * rise;
    return float2(a.x + t * (a.y + t * (c2 + t * c3)), a.y + t * (2.0 * c2 + t * 3.0 * c3));
}

// Texel i of the row: the stored value and its slope per texel.
float2 lensbake_r10_texel(int i) {
    return float2(lensbake_r10_numbers[2 * i], lensbake_r10_numbers[2 * i + 1]);
}

// The stored value at the position q, from 0 at the edge of the shadow to 1 straight away from the hole.
float lensbake_r10_stored_value(float q) {
    float position = q * 63.0;
    int i = int(min(position, 62.0));
    float2 a = lensbake_r10_texel(i);
    float2 b = lensbake_r10_texel(i + 1);
    float2 mixed = lensbake_r10_cubic(a, b, position - float(i));
    return mixed.x;
}

// The bending (deflection angle) in rad of the light that is seen at the angle theta from the direction of the hole,
// with cos(theta) = c and sin(theta) = p. It comes from the angle theta - bend. 1e4 if the ray ends in the hole.
float lensbake_r10_bend(float c, float p, lensbake_r10_ShadowEdge edge) {
    float x = lensbake_r10_row_coordinate(c, p, edge);
    if (x >= 1.0) {
        return 1e4;
    }
    float d = 1.0 - x;
    float stored = lensbake_r10_stored_value(lensbake_r10_row_position(d, sqrt(x)));
    return stored - (1.0 + edge.log_weight * d) * log(d);
}

// (cos, sin) of an angle in rad, to 1e-7 up to 100 turns. The built-in pair need only be good to
// 5e-4 on a Vulkan device, which is half a pixel.
float2 lensbake_r10_cos_sin(float angle) {
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
float2 lensbake_r10_turned(float c, float p, float bend) {
    float2 t = lensbake_r10_cos_sin(bend);
    return float2(c * t.x + p * t.y, p * t.x - c * t.y);
}

// The direction on the sky from which the light comes that is seen in the direction d; hole is the direction of the hole.
// All are unit vectors in any one frame. (0, 0, 0) if the ray ends in the hole.
float3 lensbake_r10(float3 d, float3 hole) {
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
    float angle = lensbake_r10_bend(c, p, lensbake_r10_shadow_edge());
    if (angle > 1e3) {
        return float3(0.0, 0.0, 0.0);
    }
    float2 sky = lensbake_r10_turned(c, p, angle);
    float across = sky.y / max(p, 1e-30);
    return float3(
        sky.x * hole.x + across * x,
        sky.x * hole.y + across * y,
        sky.x * hole.z + across * z
    );
}

#endif
