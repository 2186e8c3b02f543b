#pragma once
// The shot's triangles for ray tracing: world-space copies in an Embree 3 scene, and what a ray sees where it hits.

#include "reference/texture.h"
#include "scene/shot.h"

#include <algorithm>
#include <embree3/rtcore.h>
#include <memory>
#include <tbb/cache_aligned_allocator.h>

namespace bounce {

/// What a ray hit.
struct Hit {
    uint32_t geometry = RTC_INVALID_GEOMETRY_ID; ///< index of the instance
    uint32_t triangle = 0;
    float u = 0, v = 0;
    float distance = 0;
    bool valid() const { return geometry != RTC_INVALID_GEOMETRY_ID; }
};

/// A point of a triangle, as a corner and what leads from it to the point. Far from the origin a float cannot tell
/// where the point is; what leads to another point nearby can still be told, because the difference of nearby floats is
/// exact.
struct Place {
    glm::vec3 anchor, local;
    glm::vec3 position() const { return anchor + local; }
    glm::vec3 to(const glm::vec3& point) const { return (point - anchor) - local; }
    glm::vec3 to(const Place& other) const { return (other.anchor - anchor) + (other.local - local); }
};

/// The surface at a hit, seen from the ray's side.
struct Surface {
    Place place;
    float offset;        ///< metres by which rays are moved off the surface
    glm::vec3 geometric; ///< unit normal of the triangle, toward the viewer
    int material;
    glm::vec3 shading; ///< unit normal for shading (interpolated, normal-mapped), on the geometric normal's side
    float metallic;
    glm::vec3 base_colour; ///< linear
    float roughness;
    glm::vec3 emission; ///< W/(sr·m²), alike to both sides
    /// Where rays to the viewer's side start. Light is evaluated at `place`.
    glm::vec3 origin() const { return place.position() + offset * geometric; }
};

/// A ray as it was traced; kept only for measurements.
struct TracedRay {
    glm::vec3 origin;
    float length;
    glm::vec3 direction;
    bool shadow;
};

class TraceGeometry {
  public:
    /// Copies what it needs of the shot at one frame. Built by one thread in a fixed order, so that the same scene
    /// always gives the same tree (where two triangles lie in one place, the tree decides which one is hit).
    TraceGeometry(const Shot& shot, const SceneState& state, bool diffuse_only);
    ~TraceGeometry();
    TraceGeometry(const TraceGeometry&) = delete;
    TraceGeometry& operator=(const TraceGeometry&) = delete;

    /// The nearest hit of a ray with unit direction. Where the alpha test fails it passes through, and blended surfaces
    /// stop it with the probability alpha: a draw of its own for each triangle, from the ray's `coverage_seed`. Seed 0
    /// stops it from alpha ½ on.
    Hit intersect(const glm::vec3& origin, const glm::vec3& direction, float length, uint32_t coverage_seed = 0) const;
    /// Whether anything lies on origin + t·direction for 0 < t < length (in units of the direction's length).
    bool occluded(const glm::vec3& origin, const glm::vec3& direction, float length, uint32_t coverage_seed = 0) const;
    /// Whether any material is blended, so that seeds matter.
    bool blended() const { return blended_; }
    Surface surface(const Hit& hit, const glm::vec3& ray_direction) const;
    Place place(const Hit& hit) const;
    /// The same in four steps, each of which asks for the memory that the next one reads: hits are scattered over the
    /// scene, and a caller with several paths at hand takes each step for all of them, so that their ways from memory
    /// overlap.
    struct SurfacePlace;
    void prefetch_indices(const Hit& hit) const;
    void prefetch_corners(const Hit& hit) const;
    SurfacePlace find_surface(const Hit& hit) const;
    Surface read_surface(const SurfacePlace& place, const Hit& hit, const glm::vec3& ray_direction) const;

    struct Geometry {
        /// World space. A vertex is as long as a cache line and lies on one.
        std::vector<Vertex, tbb::cache_aligned_allocator<Vertex>> vertices;
        std::vector<uint32_t> indices;
        int material = 0;
        bool vertex_colours = false;
        bool mirrored = false;
        size_t triangle_count() const { return indices.size() / 3; }
    };
    const std::vector<Geometry>& geometries() const { return geometries_; }
    const Bounds& bounds() const { return bounds_; }
    bool emissive(const Geometry& geometry) const { return materials_[size_t(geometry.material)].emissive; }
    /// Emitted radiance where a ray hit a triangle.
    glm::vec3 emission(const Geometry& geometry, uint32_t triangle, float u, float v) const;
    /// The same at a point that no ray has hit: times its coverage, which is 0 where the alpha test fails.
    glm::vec3 expected_emission(const Geometry& geometry, uint32_t triangle, float u, float v) const;
    /// The mean of it over the triangle and the largest value there can be, for sampling. The mean is approximate.
    glm::vec3 mean_emission(const Geometry& geometry, uint32_t triangle) const;
    glm::vec3 largest_emission(const Geometry& geometry) const;

    RTCScene embree_scene() const { return scene_; }

  private:
    struct TextureUse {
        const ReferenceTexture* texture = nullptr;
        SlotTransform transform;
    };
    struct TraceMaterial {
        glm::vec4 base_colour;
        glm::vec3 emission;
        float metallic, roughness, normal_scale, alpha_cutoff;
        AlphaMode alpha_mode;
        bool emissive;
        /// Whether the texture's taps are the base colour's: one set of them then serves all.
        bool shared_metallic_roughness = false, shared_normal = false;
        TextureUse base_colour_texture, metallic_roughness_texture, normal_texture, emission_texture;
    };
    struct Corners {
        const Vertex *a, *b, *c;
    };

    void add_material(const Material& material, bool normal_maps);
    void add_geometry(const Scene& scene, const Instance& instance);
    void build();
    TextureUse texture_use(const TextureSlot& slot) const;
    Corners corners(const Geometry& geometry, uint32_t triangle) const;
    float coverage(const Geometry& geometry, uint32_t triangle, float u, float v) const;
    static void filter(const RTCFilterFunctionNArguments* arguments);

    std::vector<ReferenceTexture> textures_;
    std::vector<TraceMaterial> materials_;
    std::vector<Geometry> geometries_;
    struct FilterData {
        const TraceGeometry* owner;
        const Geometry* geometry;
    };
    std::vector<FilterData> filter_data_;
    Bounds bounds_;
    bool blended_ = false;
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
};

struct TraceGeometry::SurfacePlace {
    const TraceMaterial* material;
    Corners corners;
    TextureTaps colour, metallic_roughness, normal;
};

inline Surface TraceGeometry::surface(const Hit& hit, const glm::vec3& ray_direction) const {
    return read_surface(find_surface(hit), hit, ray_direction);
}

/// The triangle's edge vectors crossed: twice its area long. For sampling emitters.
glm::vec3 triangle_cross(const TraceGeometry::Geometry& geometry, uint32_t triangle);
/// Half of the last place of 1: what rounding takes from a float at most, as a share of it.
constexpr float k_float_rounding = 5.9604645e-8f;

/// The point of a triangle at barycentric coordinates u, v.
inline Place place_on(const glm::vec3& a, const glm::vec3& edge1, const glm::vec3& edge2, float u, float v) {
    return {a, u * edge1 + v * edge2};
}
/// By how much a ray must start off a triangle, along its unit normal, so as not to hit it: as far as the numbers of
/// the point and of the intersection can be off, axis by axis (as in PBRT, section 6.8.4). `place.anchor` is the corner
/// that the edges start from. The point: its coordinates are rounded twice, once moved. The intersection: sums of
/// products of what leads from the ray's origin to the corners.
inline float safe_offset(const Place& place, const glm::vec3& edge1, const glm::vec3& edge2, const glm::vec3& normal) {
    const glm::vec3 extent = glm::abs(edge1) + glm::abs(edge2);
    const glm::vec3 error = k_float_rounding * (3.0f * glm::abs(place.position()) + 16.0f * extent);
    // A triangle across an axis is off by nothing along the others: some distance is needed all the same.
    return glm::dot(glm::abs(normal), error) + 4 * k_float_rounding * std::max(extent.x, std::max(extent.y, extent.z));
}

} // namespace bounce
