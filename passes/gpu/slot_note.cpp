#include "gpu/slot_note.h"

#include "core/error.h"
#include "core/scanner.h"
#include "core/text.h"

#include <fmt/format.h>

namespace bounce {

static std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> words;
    for (const std::string& word : split(text, ' '))
        if (!word.empty()) words.push_back(word);
    return words;
}

/// At commas that stand in no parentheses.
static std::vector<std::string> parts_of(std::string_view note) {
    std::vector<std::string> parts(1);
    int depth = 0;
    for (char c : note) {
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        const bool is_reason = trim(parts.back()).starts_with("ordered:"); // which goes on to the end
        if (c == ',' && depth == 0 && !is_reason)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    for (std::string& part : parts)
        part = std::string(trim(part));
    return parts;
}

static glm::vec4 read_neutral(const std::vector<std::string>& words) {
    ParameterInfo number;
    number.name = "neutral";
    if (words.size() != 2 && words.size() != 5) throw Error("'neutral' takes one number, or four: neutral 1");
    glm::vec4 neutral(0);
    for (int i = 0; i < 4; ++i)
        neutral[i] =
            std::get<float>(parse_value(number, std::string_view(words[words.size() == 2 ? 1 : size_t(i) + 1])));
    return neutral;
}

static void read_source(const std::string& part, const std::vector<std::string>& words, ShaderSlot& slot) {
    const char* form = "'from' is written: from group.name, with \"mip EXPRESSION\" or \"layer EXPRESSION\" for one";
    if (words.size() < 2 || words[1].find('.') == std::string::npos || words.size() == 3) throw Error(form);
    slot.from = words[1];
    if (words.size() == 2) return;
    std::string expression(trim(
        std::string_view(part).substr(part.find(words[2], part.find(words[1]) + words[1].size()) + words[2].size())));
    if (words[2] == "mip")
        slot.from_mip = expression;
    else if (words[2] == "layer")
        slot.from_layer = expression;
    else
        throw Error(form);
}

void read_slot_note(std::string_view note, ShaderSlot& slot) {
    note = trim(note.substr(0, note.find("//")));
    for (const std::string& part : parts_of(note)) {
        std::vector<std::string> words = words_of(part);
        const std::string word = words.empty() ? "" : words.front();
        if (word == "optional" && words.size() == 1)
            slot.optional = true;
        else if (word == "optional" && words.size() > 2 && words[1] == "unless")
            slot.optional = true, slot.required_if = trim(std::string_view(part).substr(part.find("unless") + 6));
        else if (word == "neutral")
            slot.neutral = read_neutral(words);
        else if (word == "from")
            read_source(part, words, slot);
        else if (word == "ordered:" && words.size() > 1)
            slot.ordered = trim(std::string_view(part).substr(word.size()));
        else
            throw Error(fmt::format(
                "invalid note '{}' of slot '{}': expected optional, neutral VALUE, from NAME or ordered: REASON{}",
                shortened(part), shortened(slot.name),
                did_you_mean(word, {"optional", "neutral", "from", "ordered:"})));
    }
}

} // namespace bounce
