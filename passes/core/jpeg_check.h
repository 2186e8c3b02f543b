#pragma once
// A JPEG gone through before it is decoded: the decoder behind it trusts the tables that the file brings.

#include <cstddef>
#include <cstdint>
#include <string>

namespace bounce {

/// Whether the decoder takes these bytes for a JPEG.
bool is_jpeg(const uint8_t* data, size_t size);

/// Throws Error that begins with `what` unless every Huffman table has 255 codes at most, and every scan uses tables
/// that stand before it (ITU-T T.81, B.2.4). Other damage is left to the decoder, which tells it.
void check_jpeg(const uint8_t* data, size_t size, const std::string& what);

} // namespace bounce
