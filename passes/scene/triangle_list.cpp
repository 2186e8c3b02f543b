#include "scene/triangle_list.h"

#include <algorithm>

namespace bounce {

std::vector<uint32_t> triangles_of_strip(const std::vector<uint32_t>& strip) {
    std::vector<uint32_t> out;
    if (strip.size() < 3) return out;
    out.reserve((strip.size() - 2) * 3);
    for (size_t i = 0; i + 2 < strip.size(); ++i) {
        uint32_t a = strip[i], b = strip[i + 1 + i % 2], c = strip[i + 2 - i % 2];
        if (a != b && b != c && c != a) out.insert(out.end(), {a, b, c});
    }
    return out;
}

std::vector<uint32_t> triangles_of_fan(const std::vector<uint32_t>& fan) {
    std::vector<uint32_t> out;
    if (fan.size() < 3) return out;
    out.reserve((fan.size() - 2) * 3);
    for (size_t i = 0; i + 2 < fan.size(); ++i)
        out.insert(out.end(), {fan[i + 1], fan[i + 2], fan[0]});
    return out;
}

std::vector<Vertex> used_vertices(const std::vector<Vertex>& vertices, std::vector<uint32_t>& indices) {
    std::vector<uint32_t> used = indices;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<Vertex> out;
    out.reserve(used.size());
    for (uint32_t index : used)
        out.push_back(vertices[index]);
    for (uint32_t& index : indices)
        index = uint32_t(std::lower_bound(used.begin(), used.end(), index) - used.begin());
    return out;
}

} // namespace bounce
