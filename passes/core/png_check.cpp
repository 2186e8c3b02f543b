#include "core/png_check.h"

#include "core/error.h"
#include "core/limits.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <zlib.h>

namespace bounce {

namespace {

constexpr size_t k_signature = 8;

uint32_t number_at(const uint8_t* at) {
    return uint32_t(at[0]) << 24 | uint32_t(at[1]) << 16 | uint32_t(at[2]) << 8 | at[3];
}

class PngCheck {
  public:
    PngCheck(const uint8_t* data, size_t size, const std::string& what) : data_(data), size_(size), what_(what) {
        if (inflateInit(&stream_) != Z_OK) throw Error(what + ": out of memory");
    }
    ~PngCheck() { inflateEnd(&stream_); }
    PngCheck(const PngCheck&) = delete;
    PngCheck& operator=(const PngCheck&) = delete;

    void run() {
        for (size_t at = k_signature; size_ - at >= 8;) {
            const uint32_t length = number_at(data_ + at);
            const std::string type(reinterpret_cast<const char*>(data_ + at + 4), 4);
            if (type == "IEND") break;
            if (length > size_ - at - 8) fail("it ends within a chunk");
            const uint8_t* content = data_ + at + 8;
            if (type == "IHDR")
                read_header(content, length);
            else if (type == "CgBI")
                fail("it is not a standard PNG, but a form for a telephone");
            else if (type == "IDAT")
                unfold(content, length);
            at += 8 + size_t(length);
            at += std::min<size_t>(4, size_ - at); // its sum
        }
        if (!ended_) fail("its data are cut off");
    }

  private:
    [[noreturn]] void fail(const std::string& why) const { throw Error(what_ + ": the PNG is damaged: " + why); }

    void read_header(const uint8_t* content, uint32_t length) {
        if (length != 13) fail("its header has not 13 bytes");
        const int colour = content[9];
        const uint64_t channels = colour == 3 ? 1 : uint64_t((colour & 2 ? 3 : 1) + (colour & 4 ? 1 : 0));
        const uint64_t row = 1 + (uint64_t(number_at(content)) * channels * content[8] + 7) / 8;
        // Interlaced pictures have up to twice as many rows, and shorter ones.
        max_unfolded_ = 2 * row * number_at(content + 4) + 4096;
    }

    void unfold(const uint8_t* content, uint32_t length) {
        stream_.next_in = const_cast<Bytef*>(content); // zlib only reads it
        stream_.avail_in = length;
        std::array<uint8_t, 1 << 15> unfolded;
        while (!ended_ && stream_.avail_in > 0) {
            stream_.next_out = unfolded.data();
            stream_.avail_out = uInt(unfolded.size());
            const int status = inflate(&stream_, Z_NO_FLUSH);
            if (status != Z_OK && status != Z_STREAM_END) fail("its data do not unfold");
            unfolded_ += unfolded.size() - stream_.avail_out;
            if (unfolded_ > max_unfolded_)
                fail("its data unfold to more than its size says (" + grouped(max_unfolded_) + " bytes at most)");
            ended_ = status == Z_STREAM_END;
        }
    }

    const uint8_t* data_;
    size_t size_;
    const std::string& what_;
    z_stream stream_{};
    bool ended_ = false;
    uint64_t unfolded_ = 0, max_unfolded_ = 0;
};

} // namespace

bool is_png(const uint8_t* data, size_t size) {
    return size >= k_signature && std::memcmp(data, "\x89PNG\r\n\x1a\n", k_signature) == 0;
}

void check_png(const uint8_t* data, size_t size, const std::string& what) {
    PngCheck(data, size, what).run();
}

} // namespace bounce
