#include "scene/loaded_space.h"

#include "core/error.h"
#include "scene/extent_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace bounce {

namespace {

/// A scene or mesh is far from an origin from so many of its own sizes on: nearer, floats lose four bits at most.
constexpr double k_far = 16;
/// Sizes (metres) that are loaded as they are: squares of areas within them are ordinary floats.
constexpr double k_smallest = 1e-4, k_largest = 1e6;
/// The same for a mesh in its own coordinates, where only products of three lengths must be floats.
constexpr double k_smallest_mesh = 1e-6, k_largest_mesh = 1e6;
constexpr size_t k_max_triangles = 1 << 17;

using Triangle = std::array<glm::dvec3, 3>;

struct Extent {
    glm::dvec3 centre{0};
    double size = 0; ///< along the longest axis
    bool known = false;
};

double longest_side(const std::vector<Triangle>& triangles) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const Triangle& triangle : triangles)
        for (const glm::dvec3& corner : triangle)
            low = glm::min(low, corner), high = glm::max(high, corner);
    const glm::dvec3 sides = high - low;
    return std::max({sides.x, sides.y, sides.z});
}

/// The middle one of the corners' coordinates, along each axis.
glm::dvec3 median(const std::vector<Triangle>& triangles) {
    glm::dvec3 out(0);
    std::vector<double> values;
    for (int axis = 0; axis < 3; ++axis) {
        values.clear();
        for (const Triangle& triangle : triangles)
            for (const glm::dvec3& corner : triangle)
                values.push_back(corner[axis]);
        const auto middle = values.begin() + long(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        out[axis] = *middle;
    }
    return out;
}

/// Takes away the outermost third if what is left is so much shorter that what is taken must stray: it would say how
/// large the scene is, and floats would tell nothing of the rest.
void leave_out_strays(std::vector<Triangle>& triangles) {
    if (triangles.empty()) return;
    const glm::dvec3 middle = median(triangles);
    std::vector<std::pair<double, size_t>> far(triangles.size());
    for (size_t i = 0; i < triangles.size(); ++i) {
        far[i] = {0, i};
        for (const glm::dvec3& corner : triangles[i]) {
            const glm::dvec3 off = glm::abs(corner - middle);
            far[i].first = std::max({far[i].first, off.x, off.y, off.z});
        }
    }
    const size_t kept = triangles.size() - size_t(k_few_strays * double(triangles.size()));
    std::nth_element(far.begin(), far.begin() + long(kept) - 1, far.end());
    const double reach = far[kept - 1].first;
    std::vector<Triangle> near;
    for (const auto& [distance, i] : far)
        if (distance <= reach) near.push_back(triangles[i]);
    const double shorter = longest_side(near);
    if (shorter > 0 && shorter * double(k_collapse) <= longest_side(triangles)) triangles = std::move(near);
}

/// Of all but strays, and but the outermost points: a 64th at each end of each axis.
Extent extent_of(std::vector<Triangle> triangles) {
    Extent extent;
    leave_out_strays(triangles);
    if (triangles.empty()) return extent;
    std::vector<double> values;
    for (int axis = 0; axis < 3; ++axis) {
        values.clear();
        for (const Triangle& triangle : triangles)
            for (const glm::dvec3& corner : triangle)
                values.push_back(corner[axis]);
        const auto drop = long(values.size() / 64);
        std::nth_element(values.begin(), values.begin() + drop, values.end());
        const double low = values[size_t(drop)];
        std::nth_element(values.begin(), values.end() - 1 - drop, values.end());
        const double high = *(values.end() - 1 - drop);
        extent.centre[axis] = 0.5 * low + 0.5 * high;
        extent.size = std::max(extent.size, high - low);
    }
    extent.known = std::isfinite(extent.size) && std::isfinite(glm::dot(extent.centre, glm::dvec3(1)));
    return extent;
}

/// Takes every so-manieth triangle, counted through all primitives, so that many small ones are thinned out like few
/// large ones.
class Sampler {
  public:
    Sampler(const Scene& scene, size_t triangles) : scene_(scene), stride_(triangles / k_max_triangles + 1) {}

    void add(const Primitive& primitive, const glm::dmat4& world) {
        const size_t count = primitive.index_count / 3;
        for (; next_ < count; next_ += stride_) {
            Triangle triangle;
            bool finite = true;
            for (size_t corner = 0; corner < 3; ++corner) {
                const uint32_t index = scene_.indices[primitive.first_index + 3 * next_ + corner];
                triangle[corner] = world * glm::dvec4(scene_.vertices[index].position, 1);
                finite = finite && std::isfinite(glm::dot(triangle[corner], glm::dvec3(1)));
            }
            if (finite) triangles_.push_back(triangle);
        }
        next_ -= count;
    }
    std::vector<Triangle> take() { return std::move(triangles_); }

  private:
    const Scene& scene_;
    size_t stride_, next_ = 0;
    std::vector<Triangle> triangles_;
};

size_t triangles_of(const Mesh& mesh) {
    size_t count = 0;
    for (const Primitive& primitive : mesh.primitives)
        count += primitive.index_count / 3;
    return count;
}

bool is_far(const Extent& extent) {
    const glm::dvec3 off = glm::abs(extent.centre);
    return extent.known && extent.size > 0 && std::max({off.x, off.y, off.z}) > k_far * extent.size;
}

/// A round number near `centre`: a multiple of a power of two, a small share of the size.
glm::dvec3 round_point(const Extent& extent) {
    const double step = std::exp2(std::floor(std::log2(extent.size)) - 4);
    return glm::round(extent.centre / step) * step;
}

/// Meshes whose vertices lie between the same first and last one, because primitives share them.
struct VertexRange {
    size_t first = 0, last = 0;
    std::vector<size_t> meshes;
};

std::vector<VertexRange> vertex_ranges(const Scene& scene) {
    std::vector<VertexRange> ranges;
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        VertexRange range{scene.vertices.size(), 0, {m}};
        for (const Primitive& primitive : scene.meshes[m].primitives)
            for (uint32_t i = 0; i < primitive.index_count; ++i) {
                const size_t vertex = scene.indices[primitive.first_index + i];
                range.first = std::min(range.first, vertex);
                range.last = std::max(range.last, vertex);
            }
        if (range.first <= range.last && range.first < scene.vertices.size()) ranges.push_back(range);
    }
    std::sort(ranges.begin(), ranges.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<VertexRange> joined;
    for (VertexRange& range : ranges) {
        if (joined.empty() || range.first > joined.back().last) {
            joined.push_back(std::move(range));
            continue;
        }
        joined.back().last = std::max(joined.back().last, range.last);
        joined.back().meshes.insert(joined.back().meshes.end(), range.meshes.begin(), range.meshes.end());
    }
    return joined;
}

} // namespace

void recentre_meshes(Scene& scene) {
    std::vector<LoadedSpace> spaces(scene.meshes.size());
    for (const VertexRange& range : vertex_ranges(scene)) {
        size_t drawn = 0;
        for (size_t mesh : range.meshes)
            drawn += triangles_of(scene.meshes[mesh]);
        Sampler sampler(scene, drawn);
        for (size_t mesh : range.meshes)
            for (const Primitive& primitive : scene.meshes[mesh].primitives)
                sampler.add(primitive, glm::dmat4(1));
        const Extent extent = extent_of(sampler.take());
        LoadedSpace space;
        if (is_far(extent)) space.origin = round_point(extent);
        if (extent.known && extent.size > 0 && (extent.size < k_smallest_mesh || extent.size > k_largest_mesh))
            space.unit = std::exp2(std::round(std::log2(extent.size)));
        if (space == LoadedSpace{}) continue;
        for (size_t v = range.first; v <= range.last; ++v)
            scene.vertices[v].position = space.to_loaded(scene.vertices[v].position);
        for (size_t mesh : range.meshes)
            spaces[mesh] = space;
    }
    const size_t nodes = scene.nodes.size();
    for (size_t i = 0; i < nodes; ++i) {
        const int mesh = scene.nodes[i].mesh;
        if (mesh < 0 || spaces[size_t(mesh)] == LoadedSpace{}) continue;
        Node back;
        back.name = scene.nodes[i].name + ", to its vertices";
        back.parent = int(i);
        back.translation = spaces[size_t(mesh)].origin;
        back.scale = glm::dvec3(spaces[size_t(mesh)].unit);
        back.mesh = mesh;
        scene.nodes[i].mesh = -1;
        scene.nodes.push_back(std::move(back));
    }
}

LoadedSpace suitable_space(const Scene& scene) {
    size_t drawn = 0;
    for (const Node& node : scene.nodes)
        if (node.mesh >= 0) drawn += triangles_of(scene.meshes[size_t(node.mesh)]);
    const std::vector<glm::dmat4> worlds = file_matrices(scene, 0);
    Sampler sampler(scene, drawn);
    for (size_t n = 0; n < scene.nodes.size(); ++n)
        if (scene.nodes[n].mesh >= 0)
            for (const Primitive& primitive : scene.meshes[size_t(scene.nodes[n].mesh)].primitives)
                sampler.add(primitive, worlds[n]);
    Extent extent = extent_of(sampler.take());
    LoadedSpace space;
    if (!extent.known) return space;
    if (extent.size <= 0) extent.size = 1; // one point: what looks at it must differ from it
    if (is_far(extent)) space.origin = round_point(extent);
    if (extent.size < k_smallest || extent.size > k_largest) space.unit = std::exp2(std::round(std::log2(extent.size)));
    return space;
}

glm::dvec3 place_in_file(const LoadedSpace& space, const glm::vec3& loaded) {
    if (space != LoadedSpace{}) return space.to_file(loaded);
    const auto shortest = [](float value) { return std::stod(fmt::format("{}", value)); };
    return {shortest(loaded.x), shortest(loaded.y), shortest(loaded.z)};
}

void check_place(const glm::vec3& loaded, const std::string& what) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(loaded[axis]) <= k_farthest))
            throw Error(fmt::format("invalid place of {}: expected coordinates within {:g} of the scene's own units",
                                    what, k_farthest));
}

void check_placement(const Scene& scene, float time) {
    const std::vector<glm::mat4> worlds = world_matrices(scene, time);
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (node.mesh < 0 && node.light < 0 && node.camera < 0) continue;
        const std::string what = fmt::format("node {} '{}'", i, node.name.substr(0, 60));
        check_place(glm::vec3(worlds[i][3]), what);
        for (int column = 0; column < 3 && node.mesh >= 0; ++column)
            if (!std::isfinite(glm::dot(worlds[i][column], worlds[i][column])))
                throw Error(
                    fmt::format("invalid transform of {}: expected scales whose squares floats can hold", what));
    }
    for (const Light& light : evaluate_scene(scene, time, time).lights)
        if (!std::isfinite(light.intensity.r + light.intensity.g + light.intensity.b))
            throw Error(fmt::format("invalid intensity of light '{}': expected one whose irradiance, across a scene of "
                                    "this size, is a float",
                                    light.name.substr(0, 60)));
    const Bounds bounds = scene_bounds(scene, time);
    if (!bounds.empty() && !std::isfinite(bounds.diagonal()))
        throw Error(
            fmt::format("invalid geometry from ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}): expected vertices whose "
                        "distances floats can hold (below about 1e19 of the scene's own units)",
                        bounds.min.x, bounds.min.y, bounds.min.z, bounds.max.x, bounds.max.y, bounds.max.z));
}

} // namespace bounce
