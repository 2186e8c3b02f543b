#include "app/experiments/stability_case.h"

#include "app/experiments/table_file.h"
#include "core/asset_files.h"
#include "core/text.h"

#include <array>
#include <fmt/format.h>

namespace bounce {

using nlohmann::ordered_json;

namespace {

constexpr std::array k_quantities = {"share", "difference", "flicker", "flip", "error", "bias", "mean", "time"};
constexpr std::array k_summaries = {"worst", "first", "last", "growth"};
constexpr size_t k_max_rungs = 64;

template <size_t n>
int choice(const ordered_json& json, const char* key, const std::array<const char*, n>& choices, int otherwise,
           ErrorList& errors) {
    const std::string text = text_at(json, key, "the case", errors, false);
    if (text.empty()) return otherwise;
    for (size_t i = 0; i < n; ++i)
        if (text == choices[i]) return int(i);
    errors.add(fmt::format("{}: '{}' is none of {}", key, text,
                           join(std::vector<std::string>(choices.begin(), choices.end()), ", ")));
    return otherwise;
}

int whole_at(const ordered_json& json, const char* key, int low, int high, int otherwise, ErrorList& errors) {
    if (!json.contains(key)) return otherwise;
    const ordered_json& value = json[key];
    if (value.is_number_integer() && value >= low && value <= high) return value.get<int>();
    errors.add(fmt::format("{}: expected a whole number from {} to {}", key, low, high));
    return otherwise;
}

ordered_json object_at(const ordered_json& json, const char* key, ErrorList& errors) {
    if (!json.contains(key)) return ordered_json::object();
    if (!json[key].is_object()) errors.add(fmt::format("'{}' must be an object", key));
    return json[key].is_object() ? json[key] : ordered_json::object();
}

void read_ladder(const ordered_json& json, StabilityCase& which, ErrorList& errors) {
    const ordered_json ladder = object_at(json, "ladder", errors);
    if (ladder.size() != 1 || !ladder.front().is_array() || ladder.front().empty() ||
        ladder.front().size() > k_max_rungs) {
        errors.add(fmt::format("'ladder' must be {{\"name\": [1 … {} numbers]}}", k_max_rungs));
        return;
    }
    which.step = ladder.begin().key();
    for (const ordered_json& value : ladder.front()) {
        if (!value.is_number()) errors.add("ladder." + which.step + ": expected numbers");
        which.ladder.push_back(value.is_number() ? value.get<double>() : 0);
    }
}

} // namespace

bool is_over_time(StabilityQuantity quantity) {
    return quantity == StabilityQuantity::flicker || quantity == StabilityQuantity::flip;
}

const char* name_of(StabilityQuantity quantity) {
    return k_quantities[size_t(quantity)];
}

const char* name_of(StabilitySummary summary) {
    return k_summaries[size_t(summary)];
}

std::vector<std::string> stability_case_names() {
    return asset_names("stability");
}

StabilityCase load_stability_case(const std::string& name) {
    const std::filesystem::path path = find_asset("stability", "stability case", name);
    const ordered_json json = read_table(path);
    ErrorList errors;
    StabilityCase which;
    which.name = path.stem().string();
    which.text = json.dump();
    check_keys(json, "the case",
               {"about", "ladder", "unit", "names", "scenes", "shot", "set", "quantity", "summary", "against",
                "expected", "resource", "size", "frames", "samples", "diffuse_only", "most"},
               errors);
    which.about = text_at(json, "about", "the case", errors, true);
    which.unit = text_at(json, "unit", "the case", errors, false);
    which.expected = text_at(json, "expected", "the case", errors, false);
    if (json.contains("resource")) which.resource = text_at(json, "resource", "the case", errors, true);
    read_ladder(json, which, errors);
    which.quantity = StabilityQuantity(choice(json, "quantity", k_quantities, int(StabilityQuantity::error), errors));
    which.summary = StabilitySummary(choice(json, "summary", k_summaries, int(StabilitySummary::worst), errors));
    which.frames = whole_at(json, "frames", 1, 10000, is_over_time(which.quantity) ? 12 : 1, errors);
    which.samples = whole_at(json, "samples", 2, 1 << 20, which.samples, errors);
    if (json.contains("diffuse_only")) {
        if (json["diffuse_only"].is_boolean())
            which.diffuse_only = json["diffuse_only"].get<bool>();
        else
            errors.add("diffuse_only: expected true or false");
    }
    if (json.contains("size")) {
        const ordered_json& size = json["size"];
        const bool fits = size.is_array() && size.size() == 2 && size[0].is_number_integer() &&
                          size[1].is_number_integer() && size[0] >= 1 && size[0] <= 4096 && size[1] >= 1 &&
                          size[1] <= 4096;
        if (fits)
            which.size = {size[0].get<int>(), size[1].get<int>()};
        else
            errors.add("size: expected [width, height], from 1 to 4096");
    }
    if (json.contains("most") && json["most"].is_number())
        which.most = json["most"].get<double>();
    else
        errors.add("'most' must be a number: the mark that the figure's size must not be above");
    which.names = object_at(json, "names", errors);
    which.scenes = object_at(json, "scenes", errors);
    which.sets = object_at(json, "set", errors);
    which.against = object_at(json, "against", errors);
    std::vector<std::string> named = {which.step};
    for (const auto& [key, value] : which.names.items())
        named.push_back(key);
    check_keys(which.against, "against", named, errors);
    which.shot = json.value("shot", ordered_json());
    if (which.scenes.empty() ? !which.shot.is_string() : !which.shot.is_object())
        errors.add(which.scenes.empty() ? "'shot' must be the name of one where there are no 'scenes'"
                                        : "'shot' must be an object where there are 'scenes'");
    if (is_over_time(which.quantity) && which.frames < 3)
        errors.add("frames: expected 3 or more, for the second difference");
    if (which.quantity == StabilityQuantity::mean && which.expected.empty())
        errors.add("'expected' must be an expression where the quantity is mean");
    errors.throw_if_any(path.string());
    return which;
}

std::string stability_text(const StabilityCase& which, double value, bool summarised) {
    if (summarised && which.summary == StabilitySummary::growth) return fmt::format("{:.3g} ×", value);
    if (which.quantity == StabilityQuantity::flip) return fmt::format("{:.3g}", value);
    if (which.quantity == StabilityQuantity::time) return fmt::format("{:.3g} ms", value);
    const bool is_signed = which.quantity == StabilityQuantity::bias || which.quantity == StabilityQuantity::mean;
    return is_signed ? fmt::format("{:+.3g} %", 100 * value) : fmt::format("{:.3g} %", 100 * value);
}

} // namespace bounce
