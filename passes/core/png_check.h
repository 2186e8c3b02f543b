#pragma once
// A PNG gone through before it is decoded: the decoder behind it unfolds its data as far as they go, whatever size the
// picture has.

#include <cstddef>
#include <cstdint>
#include <string>

namespace bounce {

bool is_png(const uint8_t* data, size_t size);

/// Throws Error that begins with `what` unless chunks lie within the file, and the data are one whole zlib stream that
/// unfolds to no more than a picture of the declared size has (PNG 1.2, 2.3 to 2.6: rows with their filters). Other
/// damage is left to the decoder, which tells it.
void check_png(const uint8_t* data, size_t size, const std::string& what);

} // namespace bounce
