#include "scene/material_model.h"

#include "core/error.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

MaterialModel material_model_named(const std::string& name) {
    const auto found = std::find(k_material_models.begin(), k_material_models.end(), name);
    if (found != k_material_models.end()) return MaterialModel(found - k_material_models.begin());
    const std::vector<std::string> known(k_material_models.begin(), k_material_models.end());
    throw Error(fmt::format("invalid material model '{}': expected {}", name, join(known, ", ")));
}

} // namespace bounce
