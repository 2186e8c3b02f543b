#pragma once
// Images in memory and on disk. Row 0 is the top. Every writer writes aside and renames, so a failed write
// (full disk, killed run) leaves the old file or none.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace bounce {

/// A float image of `channels` interleaved channels (linear values).
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<float> pixels;

    Image() = default;
    Image(int w, int h, int c) : width(w), height(h), channels(c), pixels(size_t(w) * h * c, 0.0f) {}
    float* at(int x, int y) { return &pixels[(size_t(y) * width + x) * channels]; }
    const float* at(int x, int y) const { return &pixels[(size_t(y) * width + x) * channels]; }
    bool empty() const { return pixels.empty(); }
};

/// An 8-bit RGBA image, as read from a PNG, JPEG … or to be written as PNG. sRGB or linear as its user says.
struct Image8 {
    int width = 0;
    int height = 0;
    std::vector<uint8_t> rgba;
};

/// One file of named layers of the same size. A layer "out.direct" of three channels is stored as EXR channels
/// out.direct.R, .G, .B; of one channel as out.direct.Y; of two as .X, .Y; of four as .R .G .B .A. The unnamed layer
/// "" has plain channels R, G, B.
struct LayeredImage {
    std::map<std::string, Image> layers;
    std::string metadata; ///< JSON text, the value of the EXR string attribute "bounce"; may be empty
};

/// Throws Error (what, where) on failure. 32-bit float, ZIP compressed.
void write_exr(const std::filesystem::path& path, const LayeredImage& image);
/// Throws Error when the file is missing, damaged or not an EXR.
LayeredImage read_exr(const std::filesystem::path& path);

/// The bytes of a PNG file. Throws Error when the image has no pixels.
std::string encode_png(const Image8& image);
void write_png(const std::filesystem::path& path, const Image8& image);
/// PNG, JPEG, BMP, TGA … (what stb_image reads). Throws Error.
Image8 read_image8(const std::filesystem::path& path);
/// Decodes an encoded image in memory; `what` names it in errors.
Image8 decode_image8(const uint8_t* data, size_t size, const std::string& what);
/// Radiance .hdr, three channels, linear. Throws Error.
Image read_hdr(const std::filesystem::path& path);

/// The linear value in [0,1] → the sRGB-encoded one, and back.
float srgb_encode(float linear);
float srgb_decode(float encoded);

/// Writes `bytes` to `path` by way of a temporary file in the same folder and a rename. Throws Error; on failure
/// the temporary is removed and the old file is untouched.
void write_file_atomically(const std::filesystem::path& path, const std::string& bytes);
/// The whole file. Throws Error when it cannot be read.
std::string read_file(const std::filesystem::path& path);

} // namespace bounce
