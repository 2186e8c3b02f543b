// Which pixels a comparison counts.

#include "core/error.h"
#include "core/metrics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace bounce {

static glm::vec3 texel(const Image& image, int x, int y) {
    const float* p = image.at(x, y);
    return {p[0], p[1], p[2]};
}

static void check_channels(const Image& image, int channels, const std::string& what) {
    if (image.channels >= channels && !image.empty()) return;
    throw Error(fmt::format("{} needs {} channels, but has {}", what, channels, image.channels));
}

size_t Mask::count() const {
    return size_t(std::count(keep.begin(), keep.end(), uint8_t{1}));
}

Mask operator&(const Mask& a, const Mask& b) {
    if (a.width != b.width || a.height != b.height) {
        throw Error(fmt::format("the masks differ in size: {}x{} and {}x{}", a.width, a.height, b.width, b.height));
    }
    Mask both = a;
    for (size_t i = 0; i < both.keep.size(); ++i)
        both.keep[i] = uint8_t(a.keep[i] && b.keep[i]);
    return both;
}

Mask edge_mask(const Image& normal, const Image& position, const glm::vec3& camera_position) {
    check_channels(normal, 3, "the normal image");
    check_channels(position, 3, "the position image");
    if (normal.width != position.width || normal.height != position.height) {
        throw Error("the normal and the position image differ in size");
    }
    Mask mask(normal.width, normal.height);
    for (int y = 0; y < normal.height; ++y) {
        for (int x = 0; x < normal.width; ++x) {
            const glm::vec3 n = texel(normal, x, y);
            const glm::vec3 p = texel(position, x, y);
            const bool background = n == glm::vec3(0);
            const float tolerance = 0.01f * glm::length(p - camera_position);
            bool keep = true;
            for (int j = std::max(0, y - 1); j <= std::min(normal.height - 1, y + 1) && keep; ++j) {
                for (int i = std::max(0, x - 1); i <= std::min(normal.width - 1, x + 1) && keep; ++i) {
                    const glm::vec3 other = texel(normal, i, j);
                    if ((other == glm::vec3(0)) != background)
                        keep = false;
                    else if (!background) {
                        keep =
                            std::abs(glm::dot(n, texel(position, i, j) - p)) <= tolerance && glm::dot(n, other) >= 0.9f;
                    }
                    if (i == x && j == y) keep = true;
                }
            }
            mask.keep[size_t(y) * size_t(normal.width) + size_t(x)] = keep;
        }
    }
    return mask;
}

Mask surface_mask(const Image& normal) {
    check_channels(normal, 3, "the normal image");
    Mask mask(normal.width, normal.height);
    for (int y = 0; y < normal.height; ++y) {
        for (int x = 0; x < normal.width; ++x) {
            mask.keep[size_t(y) * size_t(normal.width) + size_t(x)] = texel(normal, x, y) != glm::vec3(0);
        }
    }
    return mask;
}

Mask component_mask(const Image& ids, int value) {
    check_channels(ids, 1, "the id image");
    Mask mask(ids.width, ids.height);
    for (size_t i = 0; i < mask.keep.size(); ++i) {
        mask.keep[i] = std::lround(ids.pixels[i * size_t(ids.channels)]) == value;
    }
    return mask;
}

Image surface_ids(const Image& material, const Image& normal) {
    check_channels(material, 1, "the material image");
    check_channels(normal, 3, "the normal image");
    if (normal.width != material.width || normal.height != material.height) {
        throw Error("the normal and the material image differ in size");
    }
    Image ids(normal.width, normal.height, 1);
    for (int y = 0; y < normal.height; ++y) {
        for (int x = 0; x < normal.width; ++x) {
            const glm::vec3 n = texel(normal, x, y);
            const glm::vec3 size = glm::abs(n);
            int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
            int id = 6 * int(std::lround(*material.at(x, y))) + 2 * axis + (n[axis] < 0 ? 1 : 0);
            *ids.at(x, y) = n == glm::vec3(0) ? -1.0f : float(id);
        }
    }
    return ids;
}

std::vector<std::pair<int, size_t>> component_counts(const Image& ids) {
    check_channels(ids, 1, "the id image");
    std::map<int, size_t> counts;
    for (size_t i = 0; i < ids.pixels.size(); i += size_t(ids.channels))
        ++counts[int(std::lround(ids.pixels[i]))];
    std::vector<std::pair<int, size_t>> sorted;
    for (auto& [id, count] : counts) {
        if (id >= 0) sorted.emplace_back(id, count);
    }
    std::stable_sort(sorted.begin(), sorted.end(), [](auto& a, auto& b) { return a.second > b.second; });
    return sorted;
}

} // namespace bounce
