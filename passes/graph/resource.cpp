#include "graph/resource.h"

#include "core/error.h"

#include <fmt/format.h>
#include <regex>

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
    static const std::regex form("[a-zA-Z][a-zA-Z0-9]*\\.[a-zA-Z0-9][a-zA-Z0-9_]*");
    if (std::regex_match(name, form)) return;
    throw Error(
        fmt::format("'{}' is no resource name: it has one dot and no underscore before it, as gbuffer.normal", name));
}

} // namespace bounce
