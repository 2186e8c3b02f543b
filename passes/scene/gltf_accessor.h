#pragma once
// Reads accessors: any component type, normalised or not, strided, sparse. Wants a checked source (gltf_source.h).

#include "scene/gltf_source.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace bounce {

/// Every element, missing components being 0. Integers become floats, divided by their type's largest value when the
/// accessor is normalised (signed ones clamped at −1, as glTF says). Matrices are not read (zeros).
/// `normalise`: integers are divided whether the accessor says so or not (colours are never anything else).
std::vector<glm::vec4> read_vectors(const GltfSource& source, int accessor, bool normalise = false);

/// A SCALAR accessor of unsigned integers. Throws Error that begins with `what` for other types.
std::vector<uint32_t> read_indices(const GltfSource& source, int accessor, const std::string& what);

/// Number of components (1–4) of an accessor; 0 for matrices.
int component_count(const tinygltf::Accessor& accessor);

} // namespace bounce
