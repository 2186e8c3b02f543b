#pragma once
// What ablate writes: a table, CSV, and one page with bars and maps of where in the picture each part matters.

#include "app/experiments/ablation.h"
#include "app/origin.h"

#include <filesystem>

namespace bounce {

std::string ablation_markdown(const Ablation& ablation, const AblationSettings& settings, const Origin& origin);
std::string ablation_csv(const Ablation& ablation);
/// The maps show |without − whole| over the reference's mean, from 0 to a half.
std::string ablation_html(const Ablation& ablation, const AblationSettings& settings, const Origin& origin,
                          const VariantMeasurer& measurer);

} // namespace bounce
