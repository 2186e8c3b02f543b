#include "core/parameter_steps.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace bounce {

bool are_numbers(const std::vector<std::string>& choices) {
    ParameterInfo number; // a real without bounds
    return !choices.empty() && std::all_of(choices.begin(), choices.end(), [&](const std::string& choice) {
        try {
            parse_value(number, std::string_view(choice));
            return choice.find(',') == std::string::npos;
        } catch (const Error&) {
            return false;
        }
    });
}

static double number_of(const ParameterValue& value) {
    return std::holds_alternative<int>(value) ? std::get<int>(value) : double(std::get<float>(value));
}

void choose_from(ParameterInfo& info, const std::vector<std::string>& values) {
    info.choices.clear();
    std::vector<ParameterValue> numbers;
    for (const std::string& text : values)
        numbers.push_back(parse_value(info, std::string_view(text)));
    auto below = [](const ParameterValue& a, const ParameterValue& b) { return number_of(a) < number_of(b); };
    std::sort(numbers.begin(), numbers.end(), below);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    if (numbers.empty()) return;
    for (const ParameterValue& number : numbers)
        info.choices.push_back(to_text(info, number));
    info.min = number_of(numbers.front());
    info.max = number_of(numbers.back());
}

void choose_powers_of_two(ParameterSet& set, std::string_view name) {
    ParameterInfo& info = set.find(name)->info;
    std::vector<std::string> values;
    for (int power = 0; power < 31; ++power)
        if (int value = 1 << power; value >= info.min && value <= info.max) values.push_back(std::to_string(value));
    choose_from(info, values);
}

std::vector<ParameterValue> steps_beside(const ParameterInfo& info, const ParameterValue& value) {
    std::vector<ParameterValue> beside;
    const double now = info.choices.empty() || info.kind == ParameterKind::enumeration ? 0 : number_of(value);
    if (info.kind == ParameterKind::enumeration) return beside;
    for (const std::string& choice : info.choices) {
        const ParameterValue step = parse_value(info, std::string_view(choice));
        if (number_of(step) < now)
            beside.assign(1, step); // the nearest below
        else if (number_of(step) > now) {
            beside.push_back(step);
            break;
        }
    }
    return beside;
}

} // namespace bounce
