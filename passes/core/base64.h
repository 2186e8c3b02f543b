#pragma once
// RFC 4648 base64, for pictures inside HTML.

#include <string>
#include <string_view>

namespace bounce {

std::string base64(std::string_view bytes);

} // namespace bounce
