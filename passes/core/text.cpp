#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace bounce {

/// Names are short; the time of comparing two is the product of their lengths.
static constexpr size_t k_max_compared = 200;

/// More names than these tell a person nothing.
static constexpr size_t k_max_listed = 24;

static size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 1; i <= a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            size_t above = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
            diagonal = above;
        }
    }
    return row.back();
}

std::optional<std::string> nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
    if (name.size() > k_max_compared) return std::nullopt;
    const std::string* best = nullptr;
    size_t best_distance = 0;
    for (const std::string& candidate : candidates) {
        if (candidate.size() > k_max_compared) continue;
        size_t distance = edit_distance(name, candidate);
        if (name.size() >= 3 && candidate.starts_with(name)) distance = std::min<size_t>(distance, 2); // cut short
        if (!best || distance < best_distance) {
            best = &candidate;
            best_distance = distance;
        }
    }
    if (!best || best_distance > std::max<size_t>(2, std::max(name.size(), best->size()) / 2)) return std::nullopt;
    return *best;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
    if (candidates.empty()) return " (there are none)";
    if (auto nearest = nearest_name(name, candidates)) return " (did you mean '" + *nearest + "'?)";
    // Of many names, those of the same pass: "gather.…" where 'gather.estimator' is asked for.
    std::vector<std::string> listed = candidates;
    if (const size_t dot = name.find('.'); listed.size() > k_max_listed && dot != name.npos)
        std::erase_if(listed, [&](const std::string& each) { return !each.starts_with(name.substr(0, dot + 1)); });
    if (listed.empty() || listed.size() > k_max_listed) return fmt::format(" (there are {})", candidates.size());
    const char* all = listed.size() == candidates.size() ? "there are" : "there are, among others";
    return fmt::format(" ({}: {})", all, join(listed, ", "));
}

std::string_view trim(std::string_view text) {
    const char* white = " \t\r\n";
    size_t first = text.find_first_not_of(white);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(white) - first + 1);
}

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    size_t start = 0;
    while (true) {
        size_t end = text.find(separator, start);
        parts.emplace_back(trim(text.substr(start, end == std::string_view::npos ? end : end - start)));
        if (end == std::string_view::npos) return parts;
        start = end + 1;
    }
}

std::string join(const std::vector<std::string>& parts, std::string_view separator) {
    std::string text;
    for (size_t i = 0; i < parts.size(); ++i) {
        if (i) text += separator;
        text += parts[i];
    }
    return text;
}

std::string format_bytes(double bytes) {
    if (bytes < 1024) return fmt::format("{:.0f} B", bytes);
    if (bytes < 1024.0 * 1024) return fmt::format("{:.1f} KiB", bytes / 1024);
    if (bytes < 1024.0 * 1024 * 1024) return fmt::format("{:.2f} MiB", bytes / (1024.0 * 1024));
    return fmt::format("{:.2f} GiB", bytes / (1024.0 * 1024 * 1024));
}

} // namespace bounce
