#include "core/image_budget.h"

#include "core/error.h"
#include "core/jpeg_check.h"
#include "core/limits.h"
#include "core/png_check.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <stb_image.h>

namespace bounce {

namespace {

bool begins(const uint8_t* data, size_t size, const char* magic, size_t length) {
    return size >= length && std::memcmp(data, magic, length) == 0;
}

/// Pixels that a byte of each format can hold at most. PNG: deflate repeats up to 1,032 bytes of 8 one-bit pixels.
/// JPEG: a block of 64 pixels takes a bit at least. TGA: a run of 128 takes 2 bytes; BMP: 8 one-bit pixels.
uint64_t pixels_per_byte(bool png, bool jpeg) {
    return png ? 1032 * 8 : jpeg ? 64 * 8 : 64;
}

} // namespace

DeclaredSize declared_size(const uint8_t* data, size_t size, const std::string& what) {
    const bool png = is_png(data, size), jpeg = is_jpeg(data, size);
    if (jpeg) check_jpeg(data, size, what);
    // Formats that no scene needs, and whose decoders have seen few files.
    const bool other = begins(data, size, "GIF8", 4) || begins(data, size, "8BPS", 4) ||
                       begins(data, size, "\x53\x80\xF6\x34", 4) || begins(data, size, "#?", 2) ||
                       (size > 2 && data[0] == 'P' && data[1] >= '1' && data[1] <= '7');
    DeclaredSize declared;
    int channels = 0;
    if (other || !stbi_info_from_memory(data, int(size), &declared.width, &declared.height, &channels))
        throw Error(what + ": invalid image: expected a PNG or JPEG (or BMP or TGA)");
    if (declared.width < 1 || declared.height < 1 || declared.width > k_max_picture_side ||
        declared.height > k_max_picture_side)
        throw DeclaredSizeError(fmt::format("{}: invalid size {}x{}: expected sides of 1 … {} pixels", what,
                                            declared.width, declared.height, k_max_picture_side));
    if (declared.pixels() / pixels_per_byte(png, jpeg) > size)
        throw DeclaredSizeError(
            fmt::format("{}: invalid size {}x{}: so many pixels do not fit in {} bytes; the image is cut off, "
                        "or its header is false",
                        what, declared.width, declared.height, grouped(size)));
    return declared;
}

void check_texture_budget(uint64_t pixels, const std::string& what) {
    if (pixels <= max_texture_pixels()) return;
    throw Error(fmt::format("{}: {} pixels: expected at most {} in all; use smaller images, or raise --max-texture",
                            what, grouped(pixels), grouped(max_texture_pixels())));
}

namespace {

class HdrCheck {
  public:
    HdrCheck(const uint8_t* data, size_t size, const std::string& what) : data_(data), size_(size), what_(what) {}

    DeclaredSize run() {
        if (!begins(data_, size_, "#?RADIANCE\n", 11) && !begins(data_, size_, "#?RGBE\n", 7))
            throw Error(what_ + ": not a Radiance .hdr image (it does not begin with #?RADIANCE)");
        read_header();
        check_texture_budget(size_of_.pixels(), what_);
        // As the decoder chooses: run-length encoded scanlines where their width can be told, if the first one is.
        const bool encoded = size_of_.width >= 8 && size_of_.width < 32768 && left() >= 4 && data_[at_] == 2 &&
                             data_[at_ + 1] == 2 && data_[at_ + 2] < 128;
        if (encoded) {
            for (row_ = 0; row_ < size_of_.height; ++row_)
                check_scanline();
        } else if (left() / 4 < size_of_.pixels()) {
            fail(fmt::format("expected {} bytes of pixels, but {} are left", grouped(4 * size_of_.pixels()),
                             grouped(left())));
        }
        return size_of_;
    }

  private:
    size_t left() const { return size_ - at_; }
    [[noreturn]] void fail(const std::string& why) const { throw Error(what_ + ": the .hdr image is damaged: " + why); }

    std::string line() {
        constexpr size_t k_longest = 1000; // of the decoder's buffer, with some to spare
        const void* end = std::memchr(data_ + at_, '\n', std::min(left(), k_longest));
        if (!end) fail("its header does not end");
        const size_t length = size_t(static_cast<const uint8_t*>(end) - (data_ + at_));
        std::string text(reinterpret_cast<const char*>(data_ + at_), length);
        at_ += length + 1;
        return text;
    }

    void read_header() {
        line();
        bool known = false;
        for (std::string text = line(); !text.empty(); text = line())
            known = known || text == "FORMAT=32-bit_rle_rgbe";
        if (!known) fail("expected a line FORMAT=32-bit_rle_rgbe in its header");
        const std::string text = line();
        int end = 0;
        if (std::sscanf(text.c_str(), "-Y %5d +X %5d%n", &size_of_.height, &size_of_.width, &end) != 2 ||
            size_t(end) != text.size())
            fail("expected a line of the form '-Y height +X width'");
        if (size_of_.width < 1 || size_of_.height < 1 || size_of_.width > k_max_picture_side ||
            size_of_.height > k_max_picture_side)
            fail(fmt::format("its size is {}x{}: expected sides of 1 … {} pixels", size_of_.width, size_of_.height,
                             k_max_picture_side));
    }

    uint8_t next() {
        if (at_ >= size_) fail(fmt::format("it ends in row {} of {}", row_, size_of_.height));
        return data_[at_++];
    }

    void check_scanline() {
        const uint8_t first = next(), second = next(), high = next(), low = next();
        if (first != 2 || second != 2 || (high << 8 | low) != size_of_.width)
            fail(fmt::format("row {} does not begin as a row of {} pixels does", row_, size_of_.width));
        for (int channel = 0; channel < 4; ++channel) {
            for (int x = 0; x < size_of_.width;) {
                const int count = next();
                const int length = count > 128 ? count - 128 : count;
                if (length == 0 || length > size_of_.width - x)
                    fail(fmt::format("a run in row {} has {} pixels; expected 1 … {}", row_, length,
                                     size_of_.width - x));
                for (int bytes = count > 128 ? 1 : length; bytes > 0; --bytes)
                    next();
                x += length;
            }
        }
    }

    const uint8_t* data_;
    size_t size_;
    const std::string& what_;
    size_t at_ = 0;
    int row_ = 0;
    DeclaredSize size_of_;
};

} // namespace

DeclaredSize check_hdr(const uint8_t* data, size_t size, const std::string& what) {
    return HdrCheck(data, size, what).run();
}

} // namespace bounce
