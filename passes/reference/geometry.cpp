#include "reference/geometry.h"

#include "core/low_discrepancy.h"
#include "scene/brdf.h"
#include "scene/coverage.h"
#include "scene/loaded_space.h"

#include <cmath>

namespace bounce {

static glm::vec2 uv_of(const Vertex& v, int set) {
    return set == 0 ? glm::vec2(v.u0, v.v0) : glm::vec2(v.u1, v.v1);
}

static glm::vec4 colour_of(const Vertex& v) {
    return {glm::unpackUnorm2x16(v.colour_rg), glm::unpackUnorm2x16(v.colour_ba)};
}

template <class T>
static T mix_corners(const T& a, const T& b, const T& c, float u, float v) {
    return a * (1 - u - v) + b * u + c * v;
}

static glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& otherwise) {
    float length_squared = glm::dot(v, v);
    return length_squared > 1e-37f && length_squared < 1e37f ? v / std::sqrt(length_squared) : otherwise;
}

glm::vec3 triangle_cross(const TraceGeometry::Geometry& geometry, uint32_t triangle) {
    const uint32_t* i = &geometry.indices[size_t(triangle) * 3];
    const glm::vec3& a = geometry.vertices[i[0]].position;
    return glm::cross(geometry.vertices[i[1]].position - a, geometry.vertices[i[2]].position - a);
}

TraceGeometry::Corners TraceGeometry::corners(const Geometry& geometry, uint32_t triangle) const {
    const uint32_t* i = &geometry.indices[size_t(triangle) * 3];
    return {&geometry.vertices[i[0]], &geometry.vertices[i[1]], &geometry.vertices[i[2]]};
}

/// Embree may end the program on other rays: its range is ±1.8e18, and NaN is in none. Such rays meet nothing.
static bool can_be_traced(const glm::vec3& origin, const glm::vec3& direction, float length) {
    auto inside = [](const glm::vec3& v) {
        return std::abs(v.x) <= k_farthest && std::abs(v.y) <= k_farthest && std::abs(v.z) <= k_farthest;
    };
    return inside(origin) && inside(direction) && length > 0;
}

Hit TraceGeometry::intersect(const glm::vec3& origin, const glm::vec3& direction, float length,
                             uint32_t coverage_seed) const {
    if (!can_be_traced(origin, direction, length)) return {};
    RTCRayHit ray;
    ray.ray.org_x = origin.x;
    ray.ray.org_y = origin.y;
    ray.ray.org_z = origin.z;
    ray.ray.tnear = 0;
    ray.ray.dir_x = direction.x;
    ray.ray.dir_y = direction.y;
    ray.ray.dir_z = direction.z;
    ray.ray.time = 0;
    ray.ray.tfar = length;
    ray.ray.mask = ~0u;
    ray.ray.id = coverage_seed; // for the filter
    ray.ray.flags = 0;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &ray);
    return {ray.hit.geomID, ray.hit.primID, ray.hit.u, ray.hit.v, ray.ray.tfar};
}

bool TraceGeometry::occluded(const glm::vec3& origin, const glm::vec3& direction, float length,
                             uint32_t coverage_seed) const {
    if (!can_be_traced(origin, direction, length)) return false;
    RTCRay ray;
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.tnear = 0;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.time = 0;
    ray.tfar = length;
    ray.mask = ~0u;
    ray.id = coverage_seed;
    ray.flags = 0;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene_, &context, &ray);
    return ray.tfar < 0;
}

float TraceGeometry::coverage(const Geometry& geometry, uint32_t triangle, float u, float v) const {
    const TraceMaterial& material = materials_[size_t(geometry.material)];
    if (material.alpha_mode == AlphaMode::opaque) return 1;
    const Corners t = corners(geometry, triangle);
    float alpha = material.base_colour.a;
    if (const auto& use = material.base_colour_texture; use.texture) {
        const int set = use.transform.uv_set;
        alpha *= use.texture->sample_alpha(
            use.transform.apply(mix_corners(uv_of(*t.a, set), uv_of(*t.b, set), uv_of(*t.c, set), u, v)));
    }
    if (geometry.vertex_colours) alpha *= mix_corners(colour_of(*t.a), colour_of(*t.b), colour_of(*t.c), u, v).a;
    if (material.alpha_mode == AlphaMode::blend) return alpha;
    return alpha >= mask_threshold(material.alpha_cutoff) ? 1.0f : 0.0f;
}

void TraceGeometry::filter(const RTCFilterFunctionNArguments* arguments) {
    const auto* data = static_cast<const FilterData*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] != -1) continue;
        const uint32_t triangle = RTCHitN_primID(arguments->hit, arguments->N, i);
        const float u = RTCHitN_u(arguments->hit, arguments->N, i), v = RTCHitN_v(arguments->hit, arguments->N, i);
        const float coverage = data->owner->coverage(*data->geometry, triangle, u, v);
        const uint32_t seed = RTCRayN_id(arguments->ray, arguments->N, i);
        const uint32_t geometry = uint32_t(data - data->owner->filter_data_.data());
        const float threshold = seed ? coverage_threshold(hash_combine(hash_combine(seed, geometry), triangle)) : 0.5f;
        if (coverage < threshold) arguments->valid[i] = 0;
    }
}

glm::vec3 TraceGeometry::emission(const Geometry& geometry, uint32_t triangle, float u, float v) const {
    const TraceMaterial& material = materials_[size_t(geometry.material)];
    if (!material.emissive) return glm::vec3(0);
    const auto& use = material.emission_texture;
    if (!use.texture) return material.emission;
    const Corners t = corners(geometry, triangle);
    const int set = use.transform.uv_set;
    glm::vec2 uv = mix_corners(uv_of(*t.a, set), uv_of(*t.b, set), uv_of(*t.c, set), u, v);
    return material.emission * glm::vec3(use.texture->sample(use.transform.apply(uv)));
}

glm::vec3 TraceGeometry::expected_emission(const Geometry& geometry, uint32_t triangle, float u, float v) const {
    return coverage(geometry, triangle, u, v) * emission(geometry, triangle, u, v);
}

glm::vec3 TraceGeometry::largest_emission(const Geometry& geometry) const {
    const TraceMaterial& material = materials_[size_t(geometry.material)];
    const float most = material.alpha_mode == AlphaMode::blend ? material.base_colour.a : 1.0f;
    if (!material.emission_texture.texture) return most * material.emission;
    return most * material.emission * glm::vec3(material.emission_texture.texture->largest());
}

glm::vec3 TraceGeometry::mean_emission(const Geometry& geometry, uint32_t triangle) const {
    const TraceMaterial& material = materials_[size_t(geometry.material)];
    const bool even_alpha =
        material.alpha_mode == AlphaMode::blend && !material.base_colour_texture.texture && !geometry.vertex_colours;
    if (!material.emission_texture.texture && (material.alpha_mode == AlphaMode::opaque || even_alpha))
        return largest_emission(geometry);
    // A fixed grid of points; large textures on large triangles are only estimated, which costs noise, not truth.
    constexpr int k_steps = 8;
    glm::vec3 sum(0);
    for (int i = 0; i < k_steps; ++i) {
        for (int j = 0; j < k_steps; ++j) {
            float root = std::sqrt((float(i) + 0.5f) / k_steps), along = (float(j) + 0.5f) / k_steps;
            sum += expected_emission(geometry, triangle, root * (1 - along), root * along);
        }
    }
    return sum / float(k_steps * k_steps);
}

void TraceGeometry::prefetch_indices(const Hit& hit) const {
    if (hit.valid()) __builtin_prefetch(&geometries_[hit.geometry].indices[size_t(hit.triangle) * 3]);
}

void TraceGeometry::prefetch_corners(const Hit& hit) const {
    const Corners t = corners(geometries_[hit.geometry], hit.triangle);
    __builtin_prefetch(t.a);
    __builtin_prefetch(t.b);
    __builtin_prefetch(t.c);
}

Place TraceGeometry::place(const Hit& hit) const {
    const Corners t = corners(geometries_[hit.geometry], hit.triangle);
    return place_on(t.a->position, t.b->position - t.a->position, t.c->position - t.a->position, hit.u, hit.v);
}

TraceGeometry::SurfacePlace TraceGeometry::find_surface(const Hit& hit) const {
    const Geometry& geometry = geometries_[hit.geometry];
    const TraceMaterial& material = materials_[size_t(geometry.material)];
    SurfacePlace place;
    place.material = &material;
    place.corners = corners(geometry, hit.triangle);
    const Corners& t = place.corners;
    const glm::vec2 uv[2] = {mix_corners(uv_of(*t.a, 0), uv_of(*t.b, 0), uv_of(*t.c, 0), hit.u, hit.v),
                             mix_corners(uv_of(*t.a, 1), uv_of(*t.b, 1), uv_of(*t.c, 1), hit.u, hit.v)};
    auto find = [&uv](const TextureUse& use, const TextureTaps* shared, TextureTaps& taps) {
        if (!use.texture) return;
        taps = shared ? *shared : use.texture->taps(use.transform.apply(uv[use.transform.uv_set]));
        use.texture->prefetch(taps);
    };
    find(material.base_colour_texture, nullptr, place.colour);
    find(material.metallic_roughness_texture, material.shared_metallic_roughness ? &place.colour : nullptr,
         place.metallic_roughness);
    find(material.normal_texture, material.shared_normal ? &place.colour : nullptr, place.normal);
    return place;
}

Surface TraceGeometry::read_surface(const SurfacePlace& place, const Hit& hit, const glm::vec3& ray_direction) const {
    const Geometry& geometry = geometries_[hit.geometry];
    const TraceMaterial& material = *place.material;
    const Corners& t = place.corners;
    const float u = hit.u, v = hit.v;

    Surface s;
    const glm::vec3 edge1 = t.b->position - t.a->position, edge2 = t.c->position - t.a->position;
    s.place = place_on(t.a->position, edge1, edge2, u, v);
    s.geometric = unit_or(glm::cross(edge1, edge2), -ray_direction);
    if (glm::dot(s.geometric, ray_direction) > 0) s.geometric = -s.geometric;
    s.offset = safe_offset(s.place, edge1, edge2, s.geometric);
    s.material = geometry.material;

    glm::vec3 normal = unit_or(mix_corners(t.a->normal, t.b->normal, t.c->normal, u, v), s.geometric);
    if (const ReferenceTexture* texture = material.normal_texture.texture) {
        const glm::vec4 texel = texture->sample(place.normal);
        const float x = (2 * texel.x - 1) * material.normal_scale, y = (2 * texel.y - 1) * material.normal_scale;
        glm::vec3 tangent =
            mix_corners(glm::vec3(t.a->tangent), glm::vec3(t.b->tangent), glm::vec3(t.c->tangent), u, v);
        tangent -= normal * glm::dot(normal, tangent);
        if (glm::dot(tangent, tangent) > 1e-12f) {
            tangent = glm::normalize(tangent);
            // A mirroring transform turns the frame's handedness over.
            const float handedness = mix_corners(t.a->tangent.w, t.b->tangent.w, t.c->tangent.w, u, v);
            const glm::vec3 bitangent = (geometry.mirrored ? -handedness : handedness) * glm::cross(normal, tangent);
            normal = unit_or(x * tangent + y * bitangent + (2 * texel.z - 1) * normal, normal);
        }
    }
    s.shading = glm::dot(normal, s.geometric) < 0 ? -normal : normal;

    s.base_colour = material.base_colour;
    if (const ReferenceTexture* texture = material.base_colour_texture.texture) {
        s.base_colour *= glm::vec3(texture->sample(place.colour));
    }
    if (geometry.vertex_colours) {
        s.base_colour *= glm::vec3(mix_corners(colour_of(*t.a), colour_of(*t.b), colour_of(*t.c), u, v));
    }
    s.metallic = material.metallic;
    s.roughness = material.roughness;
    if (const ReferenceTexture* texture = material.metallic_roughness_texture.texture) {
        const glm::vec4 texel = texture->sample(place.metallic_roughness);
        s.metallic *= texel.b;
        s.roughness *= texel.g;
    }
    s.emission = material.emission;
    if (const auto& use = material.emission_texture; use.texture && material.emissive) {
        const int set = use.transform.uv_set;
        const glm::vec2 uv = mix_corners(uv_of(*t.a, set), uv_of(*t.b, set), uv_of(*t.c, set), u, v);
        s.emission *= glm::vec3(use.texture->sample(use.transform.apply(uv)));
    }
    return s;
}

} // namespace bounce
