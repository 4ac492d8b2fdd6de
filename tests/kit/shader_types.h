// Stand-ins for the types and functions of HLSL and of Metal's library, so that a C++ compiler takes texts in these
// languages and runs them. Filters have weights of 8 bits, as on GPUs.
#pragma once

#include <cmath>

struct float2 {
    float x, y;
    float2(float x, float y) : x(x), y(y) {}
};

struct float3 {
    float x, y, z;
    float3(float x, float y, float z) : x(x), y(y), z(z) {}
};

// A texel of a texture with two channels.
struct texel4 {
    float2 xy;
    float x, y;
    texel4(float x, float y) : xy(x, y), x(x), y(y) {}
};

struct int3 {
    int x;
    int3(int x, int, int) : x(x) {}
};

struct uint2 {
    unsigned x;
    uint2(unsigned x, unsigned) : x(x) {}
};

typedef unsigned uint;

struct Texels {
    const float *texels;
    int width, height;

    texel4 at(int x, int y) const {
        const float *texel = texels + 2 * (y * width + x);
        return texel4(texel[0], texel[1]);
    }

    // The value with linear filtering, clamped to the edge.
    texel4 filtered(float2 coordinates) const {
        int x[2], y[2];
        const float tx = between(coordinates.x, width, x), ty = between(coordinates.y, height, y);
        float line[2];
        for (int i = 0; i < 2; i++) {
            const float left = at(x[0], y[i]).x, right = at(x[1], y[i]).x;
            line[i] = left + tx * (right - left);
        }
        return texel4(line[0] + ty * (line[1] - line[0]), 0.0f);
    }

private:
    static float between(float coordinate, int size, int *nodes) {
        const float position = coordinate * (float)size - 0.5f;
        const float first = std::floor(position);
        for (int i = 0; i < 2; i++) {
            const int node = (int)first + i;
            nodes[i] = node < 0 ? 0 : node >= size ? size - 1 : node;
        }
        return std::round((position - first) * 256.0f) / 256.0f;
    }
};

struct Sampler {};

#if KIT_METAL

#define constant static const

namespace metal {
using ::float2;
using ::float3;
using ::uint2;
using std::atan;
using std::floor;
using std::log;
using std::round;
using std::sqrt;
inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }
typedef Sampler sampler;
struct level {
    explicit level(double) {}
};
template <typename T> struct texture2d {
    Texels texels;
    texture2d(const Texels &texels) : texels(texels) {}
    texel4 read(uint2 at, uint) const { return texels.at((int)at.x, 0); }
    texel4 sample(sampler, float2 at, level) const { return texels.filtered(at); }
};
} // namespace metal

#else

using std::atan;
using std::floor;
using std::log;
using std::round;
using std::sqrt;
inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }
typedef Sampler SamplerState;
struct Texture2D {
    Texels texels;
    Texture2D(const Texels &texels) : texels(texels) {}
    texel4 Load(int3 at) const { return texels.at(at.x, 0); }
    texel4 SampleLevel(SamplerState, float2 at, double) const { return texels.filtered(at); }
};

#endif
