#include "gpu/slot_reader.h"

#include "core/scanner.h"
#include "core/text.h"

#include <algorithm>

namespace bounce {

/// Words and marks of a declaration: a table of constants is not kept, however long it is.
static constexpr size_t k_max_words = 4096;

static bool is_opaque_type(std::string_view type, SlotKind& kind) {
    if (type.starts_with("i") && !type.starts_with("image")) type.remove_prefix(1);
    if (type.starts_with("u")) type.remove_prefix(1);
    kind = type.starts_with("sampler") ? SlotKind::sampled : SlotKind::image;
    return (type.starts_with("sampler") && type.size() > 7) || (type.starts_with("image") && type.size() > 5);
}

bool SlotReader::has(std::string_view word) const {
    return std::find(words_.begin(), words_.end(), word) != words_.end();
}

SlotReader::Found SlotReader::slot_of(SlotKind kind, const std::string& type, const std::string& identifier) const {
    ShaderSlot slot;
    slot.kind = kind;
    slot.type = type;
    slot.identifier = identifier;
    slot.name = slot_name(identifier);
    slot.writes = kind != SlotKind::sampled && !has("readonly");
    slot.reads = !has("writeonly");
    return {slot, note_};
}

/// "layout(…) uniform sampler2D a_b, a_c[4]" before its semicolon.
void SlotReader::finish_uniform(std::vector<Found>& found) {
    SlotKind kind;
    auto type = std::find_if(words_.begin(), words_.end(), [&](auto& word) { return is_opaque_type(word, kind); });
    if (type == words_.end() || std::find(words_.begin(), type, "uniform") == type) return;
    is_opaque_type(*type, kind);
    int depth = 0; // of brackets and parentheses: an array's size is no name
    bool name_comes = true;
    for (auto word = type + 1; word != words_.end(); ++word) {
        if (*word == "[" || *word == "(") ++depth;
        if (*word == "]" || *word == ")") --depth;
        if (depth > 0) continue;
        if (*word == ",") name_comes = true;
        if (!name_comes || !is_word_character((*word)[0])) continue;
        found.push_back(slot_of(kind, *type, *word));
        name_comes = false;
    }
}

/// "layout(…) readonly buffer a_b" before its brace.
void SlotReader::finish_block(std::vector<Found>& found) {
    auto buffer = std::find(words_.begin(), words_.end(), "buffer");
    if (buffer == words_.end() || buffer + 1 == words_.end()) return;
    if (!is_word_character(words_.back()[0])) return;
    found.push_back(slot_of(SlotKind::storage, "", words_.back()));
}

std::vector<SlotReader::Found> SlotReader::read(std::string_view code, std::string_view mark) {
    std::vector<Found> found;
    Scanner scanner(code);
    while (!scanner.space().at_end()) {
        std::string_view word = scanner.word();
        if (word.empty()) {
            word = scanner.rest().substr(0, 1);
            scanner.take(word[0]);
        }
        if (!mark.empty()) note_ = mark;
        if (word == ";" || word == "{" || word == "}") {
            if (!too_long_ && word == ";") finish_uniform(found);
            if (!too_long_ && word == "{") finish_block(found);
            words_.clear();
            too_long_ = false;
            note_.clear();
        } else if (words_.size() < k_max_words) {
            words_.emplace_back(word);
        } else {
            too_long_ = true;
        }
    }
    return found;
}

} // namespace bounce
