#include "core/jpeg_check.h"

#include "core/error.h"

#include <array>
#include <fmt/format.h>
#include <vector>

namespace bounce {

namespace {

/// 176 have a meaning. The decoder's tables have 256, and it takes the last one for none.
constexpr size_t k_max_codes = 255;

class JpegCheck {
  public:
    JpegCheck(const uint8_t* data, size_t size, const std::string& what) : data_(data), size_(size), what_(what) {}

    void run() {
        while (at_ < size_ && data_[at_] == 0xFF)
            ++at_;
        ++at_; // the marker of its start
        bool in_scan = false;
        for (int marker = next_marker(in_scan); marker >= 0; marker = next_marker(in_scan)) {
            const size_t length = left() >= 2 ? size_t(data_[at_] << 8 | data_[at_ + 1]) : 0;
            // Where the decoder gives up, there is nothing left to check. It reads zeros behind the end, though.
            if (marker == 0xD9 || length < 2) return;
            if (length > left()) {
                if (marker >= 0xE0) return;
                fail(fmt::format("it ends within the segment of marker {:02x}", marker));
            }
            const uint8_t* content = data_ + at_ + 2;
            const size_t bytes = length - 2;
            at_ += length;
            in_scan = marker == 0xDA;
            if (marker == 0xC4) {
                huffman_tables(content, bytes);
            } else if (marker == 0xDB) {
                quantization_tables(content, bytes);
            } else if (marker >= 0xC0 && marker <= 0xC2) {
                frame(content, bytes, marker == 0xC2);
            } else if (marker == 0xDA) {
                scan(content, bytes);
            }
        }
    }

  private:
    struct Component {
        uint8_t id = 0, quantization = 0;
    };

    size_t left() const { return size_ - at_; }
    [[noreturn]] void fail(const std::string& why) const { throw Error(what_ + ": the JPEG is damaged: " + why); }

    /// −1 at the end. In the bits of a scan, a zero after 0xFF makes it one of them, and restarts are a part of it.
    int next_marker(bool in_scan) {
        while (at_ < size_) {
            if (data_[at_++] != 0xFF) continue;
            while (at_ < size_ && data_[at_] == 0xFF)
                ++at_;
            if (at_ >= size_) return -1;
            const int marker = data_[at_++];
            if (in_scan && (marker == 0 || (marker >= 0xD0 && marker <= 0xD7))) continue;
            return marker;
        }
        return -1;
    }

    void huffman_tables(const uint8_t* content, size_t bytes) {
        constexpr size_t k_head = 17; // class and place, and how many codes there are of each length
        for (size_t at = 0; at < bytes;) {
            if (bytes - at < k_head) fail("a Huffman table is cut off");
            const int type = content[at] >> 4, place = content[at] & 15;
            if (type > 1 || place > 3) fail(fmt::format("there is no Huffman table {} of class {}", place, type));
            size_t codes = 0;
            for (size_t i = 1; i < k_head; ++i)
                codes += content[at + i];
            if (codes > k_max_codes)
                fail(fmt::format("a Huffman table has {} codes; expected at most {}", codes, k_max_codes));
            if (bytes - at - k_head < codes) fail("a Huffman table is cut off");
            huffman_[size_t(type)][size_t(place)] = true;
            at += k_head + codes;
        }
    }

    void quantization_tables(const uint8_t* content, size_t bytes) {
        for (size_t at = 0; at < bytes;) {
            const size_t length = content[at] >> 4 ? 129 : 65, place = content[at] & 15;
            if (place > 3 || bytes - at < length) fail("a quantization table is cut off");
            quantization_[place] = true;
            at += length;
        }
    }

    void frame(const uint8_t* content, size_t bytes, bool progressive) {
        progressive_ = progressive;
        components_.clear();
        if (bytes < 6 || bytes < 6 + 3 * size_t(content[5])) fail("its frame is cut off");
        for (size_t i = 0; i < content[5]; ++i)
            components_.push_back({content[6 + 3 * i], content[8 + 3 * i]});
    }

    void scan(const uint8_t* content, size_t bytes) const {
        if (bytes < 1 || bytes < 4 + 2 * size_t(content[0])) fail("a scan is cut off");
        const size_t count = content[0];
        const int first = content[1 + 2 * count], high = content[3 + 2 * count] >> 4;
        for (size_t i = 0; i < count; ++i) {
            const uint8_t id = content[1 + 2 * i], tables = content[2 + 2 * i];
            for (const Component& component : components_)
                if (component.id == id && (component.quantization > 3 || !quantization_[component.quantization]))
                    fail(fmt::format("a scan uses quantization table {}, which is not there", component.quantization));
            // A progressive scan has coefficients of one kind; one that adds a bit to the first kind needs no table.
            if (!progressive_ || (first == 0 && high == 0)) want_huffman(0, tables >> 4);
            if (!progressive_ || first > 0) want_huffman(1, tables & 15);
        }
    }

    void want_huffman(size_t type, int place) const {
        if (place > 3 || !huffman_[type][size_t(place)])
            fail(fmt::format("a scan uses Huffman table {} of class {}, which is not there", place, type));
    }

    const uint8_t* data_;
    size_t size_;
    const std::string& what_;
    size_t at_ = 0;
    bool progressive_ = false;
    std::vector<Component> components_;
    std::array<bool, 4> quantization_{};
    std::array<std::array<bool, 4>, 2> huffman_{}; ///< by class: of the first coefficients, and of the others
};

} // namespace

bool is_jpeg(const uint8_t* data, size_t size) {
    size_t at = 0;
    while (at < size && data[at] == 0xFF)
        ++at;
    return at > 0 && at < size && data[at] == 0xD8;
}

void check_jpeg(const uint8_t* data, size_t size, const std::string& what) {
    JpegCheck(data, size, what).run();
}

} // namespace bounce
