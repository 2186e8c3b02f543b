#include "core/exr_check.h"

#include "core/error.h"
#include "core/scanner.h"

#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <string>
#include <utility>

namespace bounce {

namespace {

constexpr uint32_t k_magic = 20000630, k_multipart = 0x1000;
constexpr size_t k_max_exr_name = 255;

class Walk {
  public:
    explicit Walk(std::string_view file) : left_(file) {}

    uint32_t number() {
        if (left_.size() < 4) throw Error("the file ends within a header");
        uint32_t value = 0;
        for (int i = 3; i >= 0; --i) // little-endian
            value = value << 8 | uint8_t(left_[size_t(i)]);
        left_.remove_prefix(4);
        return value;
    }
    /// Up to a zero byte, which goes with it.
    std::string_view text() {
        const size_t end = left_.find('\0');
        if (end == std::string_view::npos) throw Error("the file ends within a header");
        if (end > k_max_exr_name)
            throw Error(fmt::format("a name in its header has {} bytes: expected at most {}", end, k_max_exr_name));
        const std::string_view text = left_.substr(0, end);
        left_.remove_prefix(end + 1);
        return text;
    }
    std::string_view bytes(uint32_t size) {
        const std::string_view out = left_.substr(0, size);
        left_.remove_prefix(size);
        return out;
    }
    size_t left() const { return left_.size(); }

  private:
    std::string_view left_;
};

/// Bytes of the types that always have as many: the library reads them without a look at what the attribute says.
constexpr std::pair<std::string_view, uint32_t> k_sizes[] = {{"box2f", 16},
                                                             {"box2i", 16},
                                                             {"chromaticities", 32},
                                                             {"compression", 1},
                                                             {"deepImageState", 1},
                                                             {"double", 8},
                                                             {"envmap", 1},
                                                             {"float", 4},
                                                             {"int", 4},
                                                             {"keycode", 28},
                                                             {"lineOrder", 1},
                                                             {"m33d", 72},
                                                             {"m33f", 36},
                                                             {"m44d", 128},
                                                             {"m44f", 64},
                                                             {"rational", 8},
                                                             {"tiledesc", 9},
                                                             {"timecode", 8},
                                                             {"v2d", 16},
                                                             {"v2f", 8},
                                                             {"v2i", 8},
                                                             {"v3d", 24},
                                                             {"v3f", 12},
                                                             {"v3i", 12}};

/// Names with 16 bytes each, and an empty name: likewise read up to that.
void check_channels(std::string_view value) {
    Walk walk(value);
    while (!walk.text().empty())
        if (walk.bytes(16).size() < 16) throw Error("its list of channels has no end");
    if (walk.left() > 0) throw Error("its list of channels ends before its attribute does");
}

void check_strings(std::string_view value) {
    for (Walk walk(value); walk.left() > 0;) {
        const uint32_t size = walk.number();
        if (size > walk.left()) throw Error("a text of it is longer than its attribute");
        walk.bytes(size);
    }
}

void check_preview(std::string_view value) {
    Walk walk(value);
    const uint64_t width = walk.number(), height = walk.number();
    if (width > UINT16_MAX || height > UINT16_MAX || 4 * width * height != walk.left())
        throw Error(fmt::format("its preview has {}×{} pixels in {} bytes", width, height, walk.left()));
}

/// The attributes of a header, up to the empty name. Whether there were any.
bool check_header(Walk& walk) {
    for (bool any = false;; any = true) {
        const std::string_view name = walk.text();
        if (name.empty()) return any;
        const std::string_view type = walk.text();
        const uint32_t size = walk.number();
        if (size > walk.left())
            throw Error(fmt::format("its attribute '{}' has {} bytes, of which the file holds {}", shortened(name),
                                    size, walk.left()));
        const std::string_view value = walk.bytes(size);
        for (const auto& [known, expected] : k_sizes)
            if (type == known && size != expected)
                throw Error(fmt::format("its attribute '{}' of type {} has {} bytes: expected {}", shortened(name),
                                        type, size, expected));
        if (type == "chlist") check_channels(value);
        if (type == "stringvector") check_strings(value);
        if (type == "preview") check_preview(value);
    }
}

} // namespace

void check_exr(std::string_view file) {
    Walk walk(file);
    if (file.size() < 8 || walk.number() != k_magic) return; // the library says so
    const bool multipart = walk.number() & k_multipart;
    while (check_header(walk) && multipart) {
    }
}

} // namespace bounce
