#pragma once
// SHA-256 (FIPS 180-4): what a page's content security policy names its script and style by.

#include <string>
#include <string_view>

namespace bounce {

/// The digest as 32 bytes.
std::string sha256(std::string_view bytes);

} // namespace bounce
