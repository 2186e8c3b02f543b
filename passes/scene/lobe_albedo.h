#pragma once
// The diffuse lobe of each material model, and directional albedos of both lobes: what a lobe reflects of light that is
// the same from all around, seen (or lit) under one cosine. The microfacet lobe's comes from a table, linear in F0; the
// diffuse lobe's of glTF's model from a closed form. glsl/lib/lobe_albedo.glsl and glsl/lib/material_model.glsl mirror
// this file.

#include "scene/brdf.h"
#include "scene/material_model.h"

#include <array>

namespace bounce {

/// (a, b) of ∫ D·V·F·⟨n·l⟩ dl = F0·a + b over a grid of cosines and roughnesses. Computed once, over visible
/// normals; off by at most 3e-3, below a cosine of .1 by at most .012 (tested against quadrature).
class LobeAlbedoTable {
  public:
    static constexpr int k_size = 32;
    /// Row j is roughness j/31; column i is the cosine (i/31)².
    std::array<glm::vec2, size_t(k_size) * k_size> entries;
    LobeAlbedoTable();
    /// Linear between the entries.
    glm::vec2 at(float cosine, float roughness) const;
};
const LobeAlbedoTable& lobe_albedo_table();

/// ∫ D·V·F·⟨n·l⟩ dl for a viewer at `cosine` to the normal.
inline glm::vec3 microfacet_albedo(const glm::vec3& f0, float roughness, float cosine) {
    const glm::vec2 ab = lobe_albedo_table().at(cosine, roughness);
    return f0 * ab.x + ab.y;
}

/// ∫ (1 − F(v·h))·⟨n·l⟩/π dl with the dielectric's F: what appendix B leaves of the diffuse lobe. A polynomial, within
/// 6e-6 of the integral.
inline float fresnel_diffuse_albedo(float cosine) {
    const float c = std::clamp(cosine, 0.0f, 1.0f);
    const float w = 0.02816111f + c * (-0.07980661f + c * (0.08627045f + c * (-0.04340026f + c * 0.00885729f)));
    return (1.0f - k_dielectric_f0) * (1.0f - w);
}
/// Its mean over the hemisphere, weighted by the cosine.
constexpr float k_mean_fresnel_diffuse_albedo = 0.956465f;

/// Appendix B's sum of lobes sends out up to 1.9 times what comes in (its section "Coupling Diffuse and Specular
/// Reflection" says so): toward a grazing viewer the microfacet lobe grows, and v·h does not tell the diffuse one. This
/// is the share, per channel, that may be left of the diffuse lobe of albedo `rho` as seen from `cosine`, so that both
/// together do not exceed 1. The pair's share is the lesser of those of v and l, which keeps the lobe reciprocal.
inline glm::vec3 diffuse_limit(const glm::vec3& rho, const glm::vec3& f0, float roughness, float cosine) {
    const glm::vec3 left = glm::max(1.0f - microfacet_albedo(f0, roughness, cosine), 0.0f);
    return glm::min(left / glm::max(rho * fresnel_diffuse_albedo(cosine), 1e-6f), 1.0f);
}

/// The diffuse lobe without the cosine; n·l above 0.
inline glm::vec3 diffuse_lobe(MaterialModel model, const glm::vec3& n, const glm::vec3& v, const glm::vec3& l,
                              const glm::vec3& base_colour, float metallic, float roughness) {
    glm::vec3 lambert = brdf_diffuse(base_colour, metallic);
    if (model == MaterialModel::plain) return lambert;
    lambert *= fresnel_diffuse_weight(v, glm::normalize(v + l));
    const float nv = glm::dot(n, v), nl = glm::dot(n, l);
    // Beyond the horizon there is no microfacet lobe.
    if (model != MaterialModel::gltf || nv <= 0 || nl <= 0) return lambert;
    const glm::vec3 rho = base_colour * (1 - metallic), f0 = brdf_f0(base_colour, metallic);
    return lambert * glm::min(diffuse_limit(rho, f0, roughness, nv), diffuse_limit(rho, f0, roughness, nl));
}

/// Its albedo with one direction known, for gathers and maps that know no half vector. It leaves out the limit of the
/// other direction: too bright by 4 % for a smooth white dielectric, by less than .5 % for albedos up to .8 with
/// roughness from .3 on.
inline glm::vec3 diffuse_albedo(MaterialModel model, const glm::vec3& base_colour, float metallic, float roughness,
                                float cosine) {
    const glm::vec3 rho = base_colour * (1 - metallic);
    if (model == MaterialModel::plain) return rho;
    const glm::vec3 seen = rho * fresnel_diffuse_albedo(cosine);
    if (model != MaterialModel::gltf || cosine <= 0) return seen;
    return seen * diffuse_limit(rho, brdf_f0(base_colour, metallic), roughness, cosine);
}

} // namespace bounce
