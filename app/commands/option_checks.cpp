#include "app/commands/option_checks.h"

#include "core/limits.h"
#include "core/scanner.h"
#include "core/text.h"
#include "gpu/shader_limits.h"
#include "scene/material_model.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace bounce {

namespace {

/// All of `text` as a number, or nothing.
template <class Number>
std::optional<Number> number_of(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

/// usage_error puts the option's name before it.
std::string refusal(const std::string& text, const std::string& expected) {
    return fmt::format("'{}': expected {}", shortened(text), expected);
}

/// "2/8" → 2, 8, whatever they are.
std::optional<std::pair<int, int>> share_of(const std::string& text) {
    Scanner scanner(text);
    const auto part = scanner.number(6);
    if (!part || !scanner.take('/')) return std::nullopt;
    const auto parts = scanner.number(6);
    if (!parts || !scanner.at_end()) return std::nullopt;
    return std::pair(*part, *parts);
}

/// Whole numbers of five digits at most, so that a product of two is no overflow.
std::optional<std::pair<int, int>> size_of(const std::string& text) {
    return scan_size(text, 1, 5);
}

} // namespace

CLI::Validator number_between(double least, double most) {
    const std::string expected = fmt::format("a number from {} to {}", least, most);
    return CLI::Validator(
        [=](std::string& text) {
            const auto number = number_of<double>(text);
            return number && *number >= least && *number <= most ? "" : refusal(text, expected); // NaN is in no range
        },
        fmt::format("in [{}, {}]", least, most));
}

CLI::Validator whole_between(long long least, long long most) {
    const std::string expected = fmt::format("a whole number from {} to {}", least, most);
    return CLI::Validator(
        [=](std::string& text) {
            const auto number = number_of<long long>(text);
            return number && *number >= least && *number <= most ? "" : refusal(text, expected);
        },
        fmt::format("in [{}, {}]", least, most));
}

static CLI::Validator size_between(int least, int most, const char* example) {
    const std::string expected = fmt::format("WIDTHxHEIGHT in pixels, each from {} to {}, as {}", least, most, example);
    return CLI::Validator(
        [=](std::string& text) {
            const auto size = size_of(text);
            const bool good =
                size && std::min(size->first, size->second) >= least && std::max(size->first, size->second) <= most;
            return good ? "" : refusal(text, expected);
        },
        "");
}

CLI::Validator picture_size() {
    return size_between(1, k_max_picture_side, "1280x720");
}

CLI::Validator window_size() {
    return size_between(100, k_max_picture_side, "1366x768");
}

CLI::Validator texture_pixels() {
    return size_between(1, 65536, "32768x16384");
}

CLI::Validator not_empty() {
    return CLI::Validator(
        [](std::string& text) { return text.empty() ? refusal(text, "a text that is not empty") : ""; }, "");
}

CLI::Validator shard() {
    return CLI::Validator(
        [](std::string& text) {
            const auto parts = share_of(text);
            const bool good = parts && parts->first < parts->second;
            return good ? "" : refusal(text, "i/n with i = 0 … n − 1, as 2/8");
        },
        "");
}

CLI::Validator odd_between(int least, int most) {
    const std::string expected = fmt::format("an odd number from {} to {}", least, most);
    return CLI::Validator(
        [=](std::string& text) {
            const auto number = number_of<int>(text);
            return number && *number >= least && *number <= most && *number % 2 ? "" : refusal(text, expected);
        },
        "");
}

CLI::Validator one_of(std::vector<std::string> names) {
    return CLI::Validator(
        [names = std::move(names)](std::string& text) {
            if (std::find(names.begin(), names.end(), text) != names.end()) return std::string();
            const auto nearest = nearest_name(text, names);
            return refusal(text, join(names, ", ") + (nearest ? " (did you mean '" + *nearest + "'?)" : ""));
        },
        "");
}

CLI::Validator shader_limit() {
    return CLI::Validator(
        [](std::string& text) {
            const size_t equals = text.find('=');
            std::vector<std::string> names;
            for (const ShaderLimitEntry& entry : shader_limit_entries())
                names.emplace_back(entry.name);
            const std::string name = text.substr(0, equals);
            if (std::find(names.begin(), names.end(), name) == names.end())
                return refusal(text, "name=N with one of these names" + did_you_mean(name, names));
            const auto limit = equals == std::string::npos
                                   ? std::nullopt
                                   : number_of<int64_t>(std::string_view(text).substr(equals + 1));
            return limit && *limit >= 1 ? std::string() : refusal(text, name + "=N, a whole number above 0");
        },
        "");
}

void add_material_model_option(CLI::App& command, std::string& model) {
    command.add_option("--material-model", model, "plain, gltf or appendix_b instead of the shot's")
        ->check(one_of({k_material_models.begin(), k_material_models.end()}));
}

glm::ivec2 parse_size(const std::string& text) {
    const auto size = size_of(text).value();
    return {size.first, size.second};
}

uint64_t parse_texture_pixels(const std::string& text) {
    const auto size = size_of(text).value();
    return uint64_t(size.first) * uint64_t(size.second);
}

std::pair<int, int> parse_shard(const std::string& text) {
    return share_of(text).value();
}

void add_device_option(CLI::App& command, int& device) {
    command.add_option("--device", device, "EGL device to render on (see --list-devices)")
        ->check(whole_between(0, 1000));
}

} // namespace bounce
