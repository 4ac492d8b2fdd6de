// Runs an exported text on rays. Compiled once for each text, as C or C++, with the macros
//   KIT_TEXT    the file to include
//   KIT_TYPES   1: vectors and textures from shader_types.h; 0: those of the text itself (C)
//   KIT_CALL    the call, with the arguments d, hole, r and data
//   KIT_HALF    in C, 1 to compute in 16-bit floats
//   KIT_ONE     in C, 1 for a text for one observer, in which no row is mixed
// Arguments: rays, texels (f32, `width` a line), width, out. A ray is 8 floats: r, d, hole, and the number of its first line of
// texels. The result is 3 floats a ray.

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#if KIT_TYPES
#include "shader_types.h"
#endif

#if KIT_HALF
#define float _Float16
typedef _Float16 Number;
#else
typedef float Number;
#endif
#include KIT_TEXT
#undef float

static float *read_floats(const char *path, size_t *count) {
    FILE *file = fopen(path, "rb");
    if (!file) {
        perror(path);
        exit(2);
    }
    fseek(file, 0, SEEK_END);
    *count = (size_t)ftell(file) / sizeof(float);
    rewind(file);
    float *floats = (float *)malloc(*count * sizeof(float) + 1);
    if (fread(floats, sizeof(float), *count, file) != *count) {
        exit(2);
    }
    fclose(file);
    return floats;
}

int main(int count, char **arguments) {
    if (count != 5) {
        return 2;
    }
    size_t ray_floats, texel_floats;
    const float *rays = read_floats(arguments[1], &ray_floats);
    const float *texels = read_floats(arguments[2], &texel_floats);
    const int width = atoi(arguments[3]);
    FILE *out = fopen(arguments[4], "wb");
    for (size_t i = 0; i + 8 <= ray_floats; i += 8) {
        const float *ray = rays + i;
        const float r = ray[0];
        const size_t line = (size_t)ray[7];
        (void)r;
        (void)line;
        (void)width;
        (void)texels;
#if KIT_TYPES
        const float3 d = float3(ray[1], ray[2], ray[3]), hole = float3(ray[4], ray[5], ray[6]);
        const Texels data = {texels + line * 2 * width, width, (int)(texel_floats / (2 * width))};
        (void)data;
        const float3 seen = KIT_CALL;
#else
        const lensbake_vec3 d = lensbake_make_vec3((Number)ray[1], (Number)ray[2], (Number)ray[3]);
        const lensbake_vec3 hole = lensbake_make_vec3((Number)ray[4], (Number)ray[5], (Number)ray[6]);
#if !KIT_ONE
        static Number data[2 * 4096];
        static float row_of = -1.0f;
        if (row_of != r) {
            lensbake_row(r, data);
            row_of = r;
        }
#endif
        const lensbake_vec3 seen = KIT_CALL;
#endif
        const float direction[3] = {(float)seen.x, (float)seen.y, (float)seen.z};
        fwrite(direction, sizeof(float), 3, out);
    }
    return fclose(out) != 0;
}
