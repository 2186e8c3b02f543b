#include "traced/scene_trees.h"

#include "core/digest.h"
#include "core/error.h"
#include "core/limits.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace bounce {

namespace {

constexpr float k_farthest_corner = 1e18f; ///< products of coordinates stay finite

bool usable(const glm::vec3 (&corners)[3]) {
    for (const glm::vec3& corner : corners)
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(corner[axis]) <= k_farthest_corner)) return false; // NaN too
    return true;
}

Texel texel_of(const glm::vec3& v, uint32_t w) {
    return {std::bit_cast<uint32_t>(v.x), std::bit_cast<uint32_t>(v.y), std::bit_cast<uint32_t>(v.z), w};
}

/// World to object; false where the object is flattened, so that there is none.
bool inverse_of(const glm::mat4& world, glm::dmat4& inverse) {
    inverse = glm::inverse(glm::dmat4(world));
    double largest = 0;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            largest = std::max(largest, std::isfinite(inverse[column][row]) ? std::abs(inverse[column][row]) : 1e300);
    double size = 0; // of what the matrix does to lengths
    for (int column = 0; column < 3; ++column)
        size = std::max(size, glm::length(glm::dvec3(world[column])));
    double determinant = std::abs(glm::determinant(glm::dmat3(glm::dmat4(world))));
    return largest < 1e18 && determinant > 1e-6 * size * size * size;
}

void clip(Bounds& bounds, const Bounds& to) {
    bounds.min = glm::max(bounds.min, to.min);
    bounds.max = glm::min(bounds.max, to.max);
}

/// The boxes of a triangle's parts below and above a plane, within `bounds`.
void split_triangle(const glm::vec3 (&corners)[3], int axis, float position, const Bounds& bounds, Bounds& low,
                    Bounds& high) {
    for (int k = 0; k < 3; ++k) {
        const glm::vec3 &a = corners[k], &b = corners[(k + 1) % 3];
        if (a[axis] <= position) low.add(a);
        if (a[axis] >= position) high.add(a);
        if ((a[axis] < position) == (b[axis] < position) || a[axis] == position || b[axis] == position) continue;
        glm::vec3 crossing = a + (b - a) * ((position - a[axis]) / (b[axis] - a[axis]));
        crossing[axis] = position;
        low.add(crossing);
        high.add(crossing);
    }
    clip(low, bounds);
    clip(high, bounds);
}

Bounds transformed(const Bounds& bounds, const glm::mat4& world) {
    Bounds out;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 at(corner & 1 ? bounds.max.x : bounds.min.x, corner & 2 ? bounds.max.y : bounds.min.y,
                           corner & 4 ? bounds.max.z : bounds.min.z);
        out.add(glm::vec3(world * glm::vec4(at, 1)));
    }
    return out;
}

} // namespace

uint64_t top_texels(uint64_t roots) {
    return k_header_texels + roots * k_root_texels + (roots ? 8 * (2 * roots - 1) : 0);
}

/// A mesh that moves has a tree of its own, unless it is flattened at the moment.
bool SceneTrees::shares(const GpuDraw& draw) const {
    glm::dmat4 inverse;
    return (settings_.share_all || (draw.flags & GpuDraw::k_dynamic)) && inverse_of(draw.world, inverse);
}

void SceneTrees::add_triangles(const Sources& sources, const GpuDraw& draw, uint32_t number, bool in_world,
                               std::vector<Triangle>& triangles) const {
    for (uint32_t i = 0; i + 2 < draw.index_count; i += 3) {
        Triangle triangle{{}, number, draw.first_index + i, draw.material};
        for (uint32_t k = 0; k < 3; ++k) {
            const glm::vec3& position = sources.vertices[sources.indices[triangle.first_corner + k]].position;
            triangle.corners[k] = in_world ? glm::vec3(draw.world * glm::vec4(position, 1)) : position;
        }
        if (usable(triangle.corners)) triangles.push_back(triangle);
    }
}

/// Returns the record's number, from 1 on.
uint32_t SceneTrees::add_alpha(const Sources& sources, const Triangle& triangle) {
    const AlphaSource& alpha = sources.alpha[triangle.material];
    float values[10] = {};
    const float s = std::sin(alpha.texture.rotation), c = std::cos(alpha.texture.rotation);
    for (uint32_t k = 0; k < 3; ++k) {
        const Vertex& vertex = sources.vertices[sources.indices[triangle.first_corner + k]];
        const glm::vec2 uv =
            (alpha.texture.uv_set == 0 ? glm::vec2(vertex.u0, vertex.v0) : glm::vec2(vertex.u1, vertex.v1)) *
            alpha.texture.scale;
        values[2 * k] = alpha.texture.offset.x + c * uv.x + s * uv.y;
        values[2 * k + 1] = alpha.texture.offset.y - s * uv.x + c * uv.y;
        values[6 + k] = alpha.alpha * glm::unpackUnorm2x16(vertex.colour_ba).y;
    }
    values[9] = alpha.mode == AlphaMode::mask ? alpha.cutoff : -2.0f;
    alpha_.resize(alpha_.size() + 3);
    std::memcpy(&alpha_[alpha_.size() - 3], values, sizeof(values));
    alpha_.back().z = triangle.material;
    return uint32_t(alpha_.size() / 3);
}

int SceneTrees::add_tree(const Sources& sources, const std::vector<Triangle>& triangles) {
    if (triangles.empty()) return -1;
    if (triangles.size() + triangles.size() / 2 > k_max_tree_triangles)
        throw Error(fmt::format("invalid scene for traced rays: {} triangles in one tree: expected at most {}",
                                grouped(triangles.size()), grouped(k_max_tree_triangles)));
    std::vector<Bounds> boxes(triangles.size());
    for (size_t i = 0; i < triangles.size(); ++i)
        for (const glm::vec3& corner : triangles[i].corners)
            boxes[i].add(corner);
    const SplitPrimitive split = [&](uint32_t i, int axis, float position, const Bounds& bounds, Bounds& low,
                                     Bounds& high) {
        split_triangle(triangles[i].corners, axis, position, bounds, low, high);
    };
    const BinaryTree binary = build_tree(boxes, settings_.leaf_size, settings_.cut ? split : SplitPrimitive{});
    const uint64_t node_texels = texels_of_nodes(binary, settings_.layout);
    const uint64_t end = rest_base_ + rest_.size() + node_texels + 3 * binary.order.size();
    if (end > k_max_tree_texels)
        throw Error(
            fmt::format("invalid scene for traced rays: its trees take {} texels of 16 bytes: expected at most {}",
                        grouped(end), grouped(k_max_tree_texels)));
    Tree& tree = trees_.emplace_back();
    tree.bounds = binary.bounds();
    tree.grid = TreeGrid(tree.bounds);
    tree.first_node = uint32_t(rest_base_ + rest_.size());
    tree.nodes_an_octant = uint32_t(binary.nodes.size());
    tree.first_triangle = uint32_t(tree.first_node + node_texels);
    rest_.reserve(rest_.size() + node_texels + 3 * binary.order.size());
    write_nodes(binary, tree.grid, settings_.layout, rest_base_, rest_);
    std::vector<uint32_t> alpha(triangles.size(), 0); // records; pieces of a triangle share one
    for (const uint32_t index : binary.order) {
        const Triangle& triangle = triangles[index];
        const bool opaque = sources.alpha[triangle.material].mode == AlphaMode::opaque;
        if (!opaque && !alpha[index]) alpha[index] = add_alpha(sources, triangle);
        rest_.push_back(texel_of(triangle.corners[0], triangle.draw));
        rest_.push_back(texel_of(triangle.corners[1], triangle.first_corner));
        rest_.push_back(texel_of(triangle.corners[2], alpha[index]));
    }
    counts_.nodes += binary.nodes.size();
    counts_.triangles += triangles.size();
    counts_.depth = std::max(counts_.depth, binary.depth);
    ++counts_.trees;
    return int(trees_.size()) - 1;
}

bool AlphaSource::operator==(const AlphaSource& other) const {
    const TextureSlot &a = texture, &b = other.texture;
    return mode == other.mode && cutoff == other.cutoff && alpha == other.alpha && a.texture == b.texture &&
           a.uv_set == b.uv_set && a.offset == b.offset && a.scale == b.scale && a.rotation == b.rotation;
}

std::vector<AlphaSource> alpha_sources(const std::vector<Material>& materials) {
    std::vector<AlphaSource> sources;
    for (const Material& material : materials) {
        AlphaSource& source = sources.emplace_back();
        source.mode = material.alpha_mode;
        if (source.mode == AlphaMode::opaque) continue; // the rest has no say
        source.cutoff = material.alpha_cutoff;
        source.alpha = material.base_colour.a;
        source.texture = material.base_colour_texture;
    }
    return sources;
}

void SceneTrees::build(const std::vector<Vertex>& vertices, const std::vector<uint32_t>& indices,
                       const std::vector<GpuDraw>& draws, const std::vector<AlphaSource>& alpha,
                       const TreeSettings& settings) {
    settings_ = settings;
    trees_.clear(), roots_.clear(), rest_.clear(), alpha_.clear();
    draws_ = draws;
    counts_ = {};
    const Sources sources{vertices, indices, alpha};
    // Roots first: what follows them starts behind the place that they take.
    uint64_t most_roots = 1;
    for (const GpuDraw& draw : draws)
        most_roots += shares(draw);
    rest_base_ = top_texels(most_roots);

    std::vector<Triangle> standing;
    for (uint32_t i = 0; i < draws.size(); ++i)
        if (!shares(draws[i])) add_triangles(sources, draws[i], i, true, standing);
    if (const int tree = add_tree(sources, standing); tree >= 0) roots_.push_back({tree, -1});
    std::map<std::array<uint32_t, 3>, int> known; // by mesh and material, whose alpha is in the tree
    for (uint32_t i = 0; i < draws.size(); ++i) {
        const GpuDraw& draw = draws[i];
        if (!shares(draw)) continue;
        const std::array<uint32_t, 3> key{draw.first_index, draw.index_count, draw.material};
        auto found = known.find(key);
        if (found == known.end()) {
            std::vector<Triangle> triangles;
            add_triangles(sources, draw, 0, false, triangles);
            found = known.emplace(key, add_tree(sources, triangles)).first;
        }
        if (found->second >= 0) roots_.push_back({found->second, int(i)});
    }
    counts_.roots = roots_.size();
    counts_.texels = rest_base_ + rest_.size();
}

bool SceneTrees::fits(const std::vector<GpuDraw>& draws) const {
    if (draws.size() != draws_.size()) return false;
    for (size_t i = 0; i < draws.size(); ++i) {
        const GpuDraw &now = draws[i], &then = draws_[i];
        if (now.material != then.material || now.first_index != then.first_index || now.index_count != then.index_count)
            return false;
        if (shares(now) != shares(then)) return false;
        if (!shares(now) && std::memcmp(&now.world, &then.world, sizeof(now.world)) != 0) return false;
    }
    return true;
}

std::vector<Texel> SceneTrees::top(const std::vector<GpuDraw>& draws) const {
    std::vector<Texel> texels(k_header_texels + roots_.size() * k_root_texels, Texel(0));
    std::vector<Bounds> boxes;
    for (size_t i = 0; i < roots_.size(); ++i) {
        const Root& root = roots_[i];
        const Tree& tree = trees_[size_t(root.tree)];
        Texel* out = &texels[k_header_texels + i * k_root_texels];
        out[0] = {tree.first_node, tree.nodes_an_octant, tree.first_triangle, root.draw < 0 ? 1u : 0u};
        out[1] = {uint32_t(root.draw), 0, 0, 0};
        out[2] = texel_of(tree.grid.min, 0);
        out[3] = texel_of(tree.grid.scale, 0);
        glm::mat4 to_object(1);
        boxes.push_back(tree.bounds);
        if (root.draw >= 0) {
            const glm::mat4& world = draws[size_t(root.draw)].world;
            glm::dmat4 inverse;
            inverse_of(world, inverse);
            to_object = glm::mat4(inverse);
            boxes.back() = transformed(tree.bounds, world);
        }
        for (int row = 0; row < 3; ++row) {
            const glm::vec4 values(to_object[0][row], to_object[1][row], to_object[2][row], to_object[3][row]);
            out[4 + row] = texel_of(glm::vec3(values), std::bit_cast<uint32_t>(values.w));
        }
    }
    const BinaryTree binary = build_tree(boxes, 1);
    const TreeGrid grid(binary.bounds());
    const auto first_node = uint32_t(texels.size());
    write_nodes(binary, grid, TreeLayout::threaded, 0, texels);
    // Leaves of the top tree name their root: there is one in each.
    for (size_t i = first_node; i < texels.size(); ++i) {
        uint32_t& word = texels[i].w;
        if (word & k_leaf_bit) word = k_leaf_bit | binary.order[word & ((1u << k_leaf_count_shift) - 1)];
    }
    Digest digest;
    for (const GpuDraw& draw : draws)
        digest.add(draw.world);
    texels[0] = {uint32_t(roots_.size()), first_node, uint32_t(binary.nodes.size()), uint32_t(digest.value())};
    texels[1] = texel_of(grid.min, 0);
    texels[2] = texel_of(grid.scale, 0);
    return texels;
}

} // namespace bounce
