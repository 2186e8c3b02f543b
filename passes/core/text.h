#pragma once
// Small text helpers that every layer uses.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bounce {

/// The candidate with the smallest edit distance to `name`, unless even that one is farther than half of its length.
std::optional<std::string> nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// " (did you mean 'x'?)" or, where nothing is near, a list of what there is (of many, those with the same text before
/// the first point, or their number); for the end of an error message.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

std::string_view trim(std::string_view text);
std::vector<std::string> split(std::string_view text, char separator);
std::string join(const std::vector<std::string>& parts, std::string_view separator);

/// "12.3 MiB", "640 B".
std::string format_bytes(double bytes);

} // namespace bounce
