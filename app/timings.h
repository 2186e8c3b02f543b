#pragma once
// What a graph costs: GPU milliseconds and bytes per pass, as a table and as JSON.

#include "app/session.h"

#include <filesystem>
#include <string>

namespace bounce {

/// A table for the terminal: pass, GPU ms (median and spread), MiB of what it made first, skipped passes with reasons.
std::string timing_table(const Session& session);
/// The same as JSON, with renderer and commit. Throws Error when it cannot be written.
void write_timings(const Session& session, const std::filesystem::path& path);

/// A pass's time in words: median, spread and runs, or that it is old, unchanged or not known.
std::string time_text(const PassTiming& timing);

/// Bytes of the resources that a pass is the first to write.
uint64_t bytes_of_pass(const Plan& plan, const std::string& id);

} // namespace bounce
