#include "graph/resource.h"

#include "core/error.h"
#include "core/scanner.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <string_view>

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

bool holds_radiance(const std::string& name) {
    static const std::set<std::string_view> parts{"out.direct",           "out.emitted",           "out.environment",
                                                  "out.indirect_diffuse", "out.indirect_specular", "out.emission"};
    return parts.contains(name) || name.ends_with(".radiance") || name.ends_with(".irradiance") ||
           name.ends_with(".emission");
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
