#pragma once
// What tune found, as a page: every point that was measured, the front, the start and the settings found.

#include "app/experiments/tune.h"
#include "app/origin.h"

namespace bounce {

std::string tune_html(const TuneSettings& settings, const TuneOutcome& outcome, const Origin& origin);

} // namespace bounce
