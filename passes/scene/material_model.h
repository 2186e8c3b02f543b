#pragma once
// How a material's two lobes are added up. A choice of the shot (`material_model`) and of the command line.

#include <array>
#include <string>
#include <string_view>

namespace bounce {

/// The values are those of `material_model` in glsl/lib/frame.glsl.
enum class MaterialModel {
    plain,      ///< ρ/π + D·V·F, as the papers have it
    gltf,       ///< glTF 2.0, appendix B, limited where it would send out more than comes in: the default
    appendix_b, ///< the same without that limit
};
constexpr std::array<std::string_view, 3> k_material_models{"plain", "gltf", "appendix_b"};

/// Throws Error for an unknown name.
MaterialModel material_model_named(const std::string& name);

} // namespace bounce
