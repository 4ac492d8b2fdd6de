// Reads a picture with tinyexr and writes it to standard output: width and height as u32, then R, G and B of
// each pixel as f32, from the top row to the bottom one, all in the machine's order of bytes.

#include <tinyexr.h>

#include <cstdint>
#include <cstdio>

static int fail(const char *what) {
    std::fprintf(stderr, "tinyexr: %s\n", what);
    return 2;
}

int main(int argc, char **argv) {
    if (argc != 2) return fail("the argument is a file");
    float *rgba = nullptr;
    int width = 0, height = 0;
    const char *error = "the file cannot be read";
    if (LoadEXR(&rgba, &width, &height, argv[1], &error) != TINYEXR_SUCCESS) return fail(error);
    const std::uint32_t size[2] = {std::uint32_t(width), std::uint32_t(height)};
    std::fwrite(size, sizeof size, 1, stdout);
    const std::size_t pixels = std::size_t(width) * std::size_t(height);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        std::fwrite(rgba + 4 * pixel, sizeof(float), 3, stdout);
    return std::fflush(stdout) == 0 ? 0 : fail("standard output cannot be written");
}
