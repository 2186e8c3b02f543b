#include "graph/resource.h"

#include "core/error.h"
#include "core/scanner.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

const char* to_string(ResourceKind kind) {
    switch (kind) {
    case ResourceKind::texture_2d:
        return "texture_2d";
    case ResourceKind::texture_2d_array:
        return "texture_2d_array";
    case ResourceKind::texture_3d:
        return "texture_3d";
    case ResourceKind::buffer:
        return "buffer";
    }
    return "";
}

Extent Extent::relative_to(const std::string& resource, double scale) {
    auto part = [&](const char* side) { return fmt::format("max(1, ceil({}.{} * {}))", resource, side, scale); };
    return {part("width"), part("height"), resource + ".depth"};
}

void check_resource_name(const std::string& name) {
    Scanner scanner(name);
    std::string_view group = scanner.word();
    bool has_dot = scanner.take('.');
    std::string_view own = scanner.word();
    bool good = has_dot && scanner.at_end() && name.size() <= k_max_name && !group.empty() && !own.empty();
    if (good && is_letter(group[0]) && group.find('_') == std::string_view::npos && own[0] != '_') return;
    throw Error(fmt::format("'{}' is no resource name: it has one dot and no underscore before it, as gbuffer.normal",
                            shortened(name)));
}

} // namespace bounce
