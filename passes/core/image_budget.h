#pragma once
// What an encoded image says of its size, judged before it is decoded: a few bytes can say anything.

#include "core/error.h"

#include <cstdint>
#include <string>

namespace bounce {

struct DeclaredSize {
    int width = 0;
    int height = 0;
    uint64_t pixels() const { return uint64_t(width) * uint64_t(height); }
};

/// An image that says it is larger than it can or may be.
class DeclaredSizeError : public Error {
  public:
    using Error::Error;
};

/// The size in the header of a PNG, JPEG, BMP or TGA. Throws Error that begins with `what` when it is none of those
/// or a JPEG that check_jpeg refuses, and DeclaredSizeError when a side is above k_max_picture_side or the file is too
/// short to hold so many pixels.
DeclaredSize declared_size(const uint8_t* data, size_t size, const std::string& what);

/// Throws Error that begins with `what` when `pixels` are more than max_texture_pixels().
void check_texture_budget(uint64_t pixels, const std::string& what);

/// A Radiance .hdr, gone through to its end: throws Error that begins with `what` unless every scanline lies within the
/// file and its runs fill it exactly. (The decoder behind it trusts its input.)
DeclaredSize check_hdr(const uint8_t* data, size_t size, const std::string& what);

} // namespace bounce
