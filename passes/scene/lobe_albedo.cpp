#include "scene/lobe_albedo.h"

namespace bounce {

namespace {

/// By visible normals over half of the disc, which mirrors the other. The lobe's long tail comes from the disc's rim,
/// where the rings lie closer: 1 − r² = s⁴.
glm::vec2 albedo_by_drawing(float cosine, float roughness) {
    constexpr int k_rings = 40, k_angles = 16;
    const float alpha = brdf_alpha(roughness);
    const glm::vec3 v(std::sqrt(1 - cosine * cosine), 0, cosine);
    double a = 0, b = 0;
    for (int i = 0; i < k_rings; ++i) {
        const float s = (float(i) + 0.5f) / k_rings, radius = std::sqrt(1 - s * s * s * s), ring = 4 * s * s * s;
        for (int j = 0; j < k_angles; ++j) {
            const float angle = k_pi * ((float(j) + 0.5f) / k_angles - 0.5f);
            const glm::vec3 h = visible_normal_of(v, alpha, radius * glm::vec2(std::cos(angle), std::sin(angle)));
            const float nl = 2 * glm::dot(v, h) * h.z - v.z;
            if (nl <= 0) continue;
            const float density = visible_normal_density(1, cosine, alpha); // D stands in both and falls out
            const float share = ring * smith_visibility(nl, cosine, alpha) * nl / density;
            const float fresnel = schlick_weight(v, h);
            a += double(share * (1 - fresnel));
            b += double(share * fresnel);
        }
    }
    return glm::vec2(a, b) / float(k_rings * k_angles);
}

} // namespace

LobeAlbedoTable::LobeAlbedoTable() {
    for (int j = 0; j < k_size; ++j) {
        for (int i = 0; i < k_size; ++i) {
            const float x = float(i) / (k_size - 1);
            entries[size_t(j * k_size + i)] = albedo_by_drawing(std::max(x * x, 1e-4f), float(j) / (k_size - 1));
        }
    }
}

glm::vec2 LobeAlbedoTable::at(float cosine, float roughness) const {
    const float x = std::sqrt(std::clamp(cosine, 0.0f, 1.0f)) * (k_size - 1);
    const float y = std::clamp(roughness, 0.0f, 1.0f) * (k_size - 1);
    const int i = std::min(int(x), k_size - 2), j = std::min(int(y), k_size - 2);
    const float u = x - float(i), v = y - float(j);
    const glm::vec2* row = &entries[size_t(j * k_size + i)];
    return glm::mix(glm::mix(row[0], row[1], u), glm::mix(row[k_size], row[k_size + 1], u), v);
}

const LobeAlbedoTable& lobe_albedo_table() {
    static const LobeAlbedoTable table;
    return table;
}

} // namespace bounce
