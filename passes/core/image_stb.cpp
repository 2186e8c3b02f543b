// 8-bit images and Radiance .hdr, through stb.

#include "core/error.h"
#include "core/image.h"
#include "core/image_budget.h"
#include "core/input_file.h"
#include "core/limits.h"
#include "core/png_check.h"

#include <algorithm>
#include <memory>
#include <stb_image.h>
#include <stb_image_write.h>

namespace bounce {

namespace {
template <class T>
struct Decoded {
    std::unique_ptr<T, void (*)(void*)> pixels{nullptr, stbi_image_free};
    int width = 0;
    int height = 0;
};
} // namespace

static void check_size(size_t size, const std::string& what) {
    if (size == 0) throw Error(what + ": the image is empty (0 bytes)");
    if (size > k_max_image_bytes) // the decoder counts in an int
        throw Error(what + ": the image has " + grouped(size) + " bytes; expected at most " +
                    grouped(k_max_image_bytes));
}

Image8 decode_image8(const uint8_t* data, size_t size, const std::string& what) {
    check_size(size, what);
    check_texture_budget(declared_size(data, size, what).pixels(), what);
    if (is_png(data, size)) check_png(data, size, what);
    Decoded<uint8_t> decoded;
    int channels = 0;
    decoded.pixels.reset(stbi_load_from_memory(data, int(size), &decoded.width, &decoded.height, &channels, 4));
    if (!decoded.pixels) throw Error(what + ": the image is damaged (" + stbi_failure_reason() + ")");
    Image8 image;
    image.width = decoded.width;
    image.height = decoded.height;
    image.rgba.assign(decoded.pixels.get(), decoded.pixels.get() + size_t(image.width) * image.height * 4);
    return image;
}

Image8 read_image8(const std::filesystem::path& path) {
    std::string bytes = read_file(path, k_max_image_bytes);
    return decode_image8(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), "'" + path.string() + "'");
}

Image read_hdr(const std::filesystem::path& path) {
    std::string what = "'" + path.string() + "'";
    std::string bytes = read_file(path, k_max_image_bytes);
    check_size(bytes.size(), what);
    const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
    check_hdr(data, bytes.size(), what);
    Decoded<float> decoded;
    int channels = 0;
    decoded.pixels.reset(
        stbi_loadf_from_memory(data, int(bytes.size()), &decoded.width, &decoded.height, &channels, 3));
    if (!decoded.pixels) throw Error(what + ": the .hdr image is damaged (" + stbi_failure_reason() + ")");
    Image image(decoded.width, decoded.height, 3);
    std::copy_n(decoded.pixels.get(), image.pixels.size(), image.pixels.begin());
    return image;
}

std::string encode_png(const Image8& image) {
    if (image.width <= 0 || image.height <= 0 || image.rgba.size() != size_t(image.width) * image.height * 4) {
        throw Error("cannot encode a PNG: the image has no pixels, or not width x height of them");
    }
    std::string bytes;
    auto append = [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data), size_t(size));
    };
    if (!stbi_write_png_to_func(append, &bytes, image.width, image.height, 4, image.rgba.data(), image.width * 4)) {
        throw Error("the PNG could not be encoded");
    }
    return bytes;
}

void write_png(const std::filesystem::path& path, const Image8& image) {
    std::string bytes;
    try {
        bytes = encode_png(image);
    } catch (const Error& error) {
        throw Error("cannot write '" + path.string() + "': " + error.what());
    }
    write_file_atomically(path, bytes);
}

} // namespace bounce
