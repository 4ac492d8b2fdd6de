// Reads channels of a picture with tinyexr and writes them to standard output: width and height as u32, then the
// channels that the arguments after the file name, at each pixel, as f32, from the top row to the bottom one, all in the
// machine's order of bytes. R, G and B alone are read by the function that most engines call.

#include <tinyexr.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

static int fail(const char *what) {
    std::fprintf(stderr, "tinyexr: %s\n", what);
    return 2;
}

static int write(int width, int height, const std::vector<float> &samples) {
    const std::uint32_t size[2] = {std::uint32_t(width), std::uint32_t(height)};
    std::fwrite(size, sizeof size, 1, stdout);
    std::fwrite(samples.data(), sizeof(float), samples.size(), stdout);
    return std::fflush(stdout) == 0 ? 0 : fail("standard output cannot be written");
}

static int rgb(const char *file) {
    float *rgba = nullptr;
    int width = 0, height = 0;
    const char *error = "the file cannot be read";
    if (LoadEXR(&rgba, &width, &height, file, &error) != TINYEXR_SUCCESS) return fail(error);
    std::vector<float> samples;
    const std::size_t pixels = std::size_t(width) * std::size_t(height);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        samples.insert(samples.end(), rgba + 4 * pixel, rgba + 4 * pixel + 3);
    return write(width, height, samples);
}

static int channels(const char *file, char **names, int count) {
    EXRVersion version;
    EXRHeader header;
    EXRImage image;
    InitEXRHeader(&header);
    InitEXRImage(&image);
    const char *error = "the file cannot be read";
    if (ParseEXRVersionFromFile(&version, file) != TINYEXR_SUCCESS) return fail(error);
    if (ParseEXRHeaderFromFile(&header, &version, file, &error) != TINYEXR_SUCCESS) return fail(error);
    if (LoadEXRImageFromFile(&image, &header, file, &error) != TINYEXR_SUCCESS) return fail(error);
    std::vector<const float *> planes;
    for (int name = 0; name < count; ++name)
        for (int channel = 0; channel < header.num_channels; ++channel)
            if (std::strcmp(header.channels[channel].name, names[name]) == 0 &&
                header.pixel_types[channel] == TINYEXR_PIXELTYPE_FLOAT)
                planes.push_back(reinterpret_cast<const float *>(image.images[channel]));
    if (planes.size() != std::size_t(count)) return fail("a channel is missing or not of 32-bit floats");
    std::vector<float> samples;
    const std::size_t pixels = std::size_t(image.width) * std::size_t(image.height);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        for (const float *plane : planes) samples.push_back(plane[pixel]);
    return write(image.width, image.height, samples);
}

int main(int argc, char **argv) {
    if (argc < 3) return fail("the arguments are a file and the names of channels");
    const bool is_rgb = argc == 5 && !std::strcmp(argv[2], "R") && !std::strcmp(argv[3], "G") && !std::strcmp(argv[4], "B");
    return is_rgb ? rgb(argv[1]) : channels(argv[1], argv + 2, argc - 2);
}
