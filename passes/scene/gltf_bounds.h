#pragma once
// Checks that what a glTF document says about its bytes is true: views in buffers, accessors in views. Nothing is
// allocated from a count before it has been checked here.

#include "core/error.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

namespace bounce {

/// `buffer_sizes`: bytes that there really are in each buffer. Wants a document that passed check_gltf_shape.
void check_gltf_bounds(const nlohmann::json& root, const std::vector<size_t>& buffer_sizes, ErrorList& errors);

} // namespace bounce
