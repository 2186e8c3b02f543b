#include "gpu/shader_order.h"

#include "gpu/glsl_tokens.h"
#include "gpu/shader_memory.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace bounce {

namespace {

using Tokens = std::vector<GlslToken>;

struct Accesses {
    bool loads = false, stores = false, atomics = false;
};

/// The token behind the bracket that is opened at `at`.
size_t behind_bracket(const Tokens& tokens, size_t at) {
    int depth = 0;
    for (; at < tokens.size(); ++at) {
        if (tokens[at] == "[") ++depth;
        if (tokens[at] == "]" && --depth == 0) return at + 1;
    }
    return at;
}

bool at(const Tokens& tokens, size_t i, std::string_view text) {
    return i < tokens.size() && tokens[i] == text;
}

/// The function whose first argument begins at i; "" of anything else.
std::string_view function_of_argument(const Tokens& tokens, size_t i) {
    return i >= 2 && tokens[i - 1] == "(" && tokens[i - 2].is_word() ? tokens[i - 2].text : std::string_view();
}

void count_image(const Tokens& tokens, size_t i, Accesses& accesses) {
    const std::string_view function = function_of_argument(tokens, i);
    accesses.loads |= function == "imageLoad";
    accesses.stores |= function == "imageStore";
    accesses.atomics |= function.starts_with("imageAtomic");
}

/// A member of a block, with what selects a part of it behind.
void count_member(const Tokens& tokens, size_t i, Accesses& accesses) {
    size_t end = i + 1;
    while (at(tokens, end, "[") || at(tokens, end, ".")) {
        if (at(tokens, end, ".") && at(tokens, end + 1, "length")) return;
        end = at(tokens, end, "[") ? behind_bracket(tokens, end) : end + 2;
    }
    if (function_of_argument(tokens, i).starts_with("atomic")) {
        accesses.atomics = true;
        return;
    }
    static constexpr std::string_view changes[] = {
        "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>=", "++", "--"};
    auto changed_by = [&](size_t k) {
        return k < tokens.size() &&
               std::find(std::begin(changes), std::end(changes), tokens[k].text) != std::end(changes);
    };
    const bool assigned = at(tokens, end, "=");
    const bool changed = changed_by(end) || at(tokens, i - 1, "++") || at(tokens, i - 1, "--");
    accesses.stores |= assigned || changed;
    accesses.loads |= !assigned;
}

/// The members of the block whose opening brace is at `open`, and its instance's name if it has one.
struct Block {
    std::set<std::string_view> members;
    std::string_view instance;
    size_t end = 0; ///< its semicolon
};

Block read_block(const Tokens& tokens, size_t open) {
    Block block;
    size_t i = open + 1;
    while (i < tokens.size() && tokens[i] != "}") {
        std::string_view name; // the last word before an array's size, a comma or the semicolon
        for (; i < tokens.size() && tokens[i] != ";"; ++i) {
            if (tokens[i] == "[")
                i = behind_bracket(tokens, i) - 1;
            else if (tokens[i] == ",")
                block.members.insert(name);
            else if (tokens[i].is_word())
                name = tokens[i].text;
        }
        if (!name.empty()) block.members.insert(name);
        ++i;
    }
    if (i + 1 < tokens.size() && tokens[i + 1].is_word()) block.instance = tokens[i + 1].text;
    block.end = i;
    return block;
}

Accesses accesses_of(const Tokens& tokens, const ShaderSlot& slot) {
    Accesses accesses;
    Block block;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (slot.kind == SlotKind::image) {
            if (tokens[i] == slot.identifier) count_image(tokens, i, accesses);
        } else if (i > 0 && tokens[i] == slot.identifier && tokens[i - 1] == "buffer" && at(tokens, i + 1, "{")) {
            block = read_block(tokens, i + 1);
            i = block.end;
        } else if (block.members.contains(tokens[i].text)) {
            const bool of_something = i > 0 && tokens[i - 1] == ".";
            const bool of_instance = of_something && i > 1 && tokens[i - 2] == block.instance;
            if (block.instance.empty() ? !of_something : of_instance) count_member(tokens, i, accesses);
        }
    }
    return accesses;
}

} // namespace

std::vector<std::string> order_problems(const ShaderSource& source) {
    std::vector<std::string> problems;
    GlslTokens text;
    try {
        text = preprocess(source.text, ShaderLimits{});
    } catch (const BeyondLimit&) {
        return problems; // such text is refused elsewhere
    }
    const std::map<std::string, ShaderMemory> declared = read_shader_memory(source.text);
    const bool has_barrier = std::any_of(text.tokens.begin(), text.tokens.end(), [](const GlslToken& token) {
        return token.text.starts_with("memoryBarrier"); // groupMemoryBarrier orders a work group alone
    });
    for (const ShaderSlot& slot : source.slots) {
        const auto memory = declared.find(slot.identifier);
        if (slot.kind == SlotKind::sampled || memory == declared.end()) continue;
        const Accesses found = accesses_of(text.tokens, slot);
        auto tell = [&](const char* what) {
            problems.push_back(fmt::format("{}: '{}' {}", slot.where, slot.identifier, what));
        };
        const bool reads = found.loads || found.atomics, writes = found.stores || found.atomics;
        const std::string file = slot.where.substr(0, slot.where.rfind(':'));
        const bool shared = !source.files.empty() && !source.files.front().generic_string().ends_with(file);
        if (!shared && reads && !writes && memory->second.writes) tell("is only read: declare it readonly");
        if (!shared && writes && !reads && memory->second.reads) tell("is only written: declare it writeonly");
        const bool mixed = (found.loads && writes) || (found.stores && found.atomics);
        if (!mixed || !slot.ordered.empty()) continue;
        if (memory->second.coherent && has_barrier) continue;
        tell("is read and written by invocations that nothing orders: declare it coherent, with a memoryBarrier "
             "between, "
             "or say why none meets another: //! ordered: REASON");
    }
    return problems;
}

} // namespace bounce
