#include "gpu/hazard_check.h"

#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

static constexpr size_t k_max_barriers = 100'000;

namespace {
struct RouteText {
    const char* text;
    GLbitfield bit;
    const char* barrier; ///< as the specification names it
};
} // namespace

static const RouteText& entry(MemoryRoute route) {
    static const RouteText entries[] = {
        {"sampler", GL_TEXTURE_FETCH_BARRIER_BIT, "GL_TEXTURE_FETCH_BARRIER_BIT"},
        {"image", GL_SHADER_IMAGE_ACCESS_BARRIER_BIT, "GL_SHADER_IMAGE_ACCESS_BARRIER_BIT"},
        {"storage block", GL_SHADER_STORAGE_BARRIER_BIT, "GL_SHADER_STORAGE_BARRIER_BIT"},
        {"uniform block", GL_UNIFORM_BARRIER_BIT, "GL_UNIFORM_BARRIER_BIT"},
        {"vertex fetch", GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT, "GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT"},
        {"index fetch", GL_ELEMENT_ARRAY_BARRIER_BIT, "GL_ELEMENT_ARRAY_BARRIER_BIT"},
        {"indirect command", GL_COMMAND_BARRIER_BIT, "GL_COMMAND_BARRIER_BIT"},
        {"framebuffer", GL_FRAMEBUFFER_BARRIER_BIT, "GL_FRAMEBUFFER_BARRIER_BIT"},
        {"texture transfer", GL_TEXTURE_UPDATE_BARRIER_BIT, "GL_TEXTURE_UPDATE_BARRIER_BIT"},
        {"buffer transfer", GL_BUFFER_UPDATE_BARRIER_BIT, "GL_BUFFER_UPDATE_BARRIER_BIT"},
    };
    return entries[size_t(route)];
}

GLbitfield barrier_bit(MemoryRoute route) {
    return entry(route).bit;
}

const char* to_string(MemoryRoute route) {
    return entry(route).text;
}

static std::string route_of(const MemoryUse& use) {
    return use.name.empty() ? to_string(use.route) : fmt::format("{} '{}'", to_string(use.route), use.name);
}

/// What stands from before within the range is known anew.
void HazardCheck::record(Accesses& accesses, const MemoryRange& range, std::string by) {
    std::erase_if(accesses, [&](const Access& access) { return range.contains(access.range); });
    accesses.push_back({range, std::move(by), {}});
}

void HazardCheck::give(Accesses& accesses, int barrier, GLbitfield bits) {
    for (Access& access : accesses) {
        GLbitfield once = 0, twice = 0;
        for (const auto& [index, given] : access.since) {
            twice |= once & given;
            once |= given;
        }
        if (bits & ~twice) access.since.emplace_back(barrier, bits & ~twice);
    }
}

/// Whether a barrier with the bit came after the access; counts it as needed where no other one did.
bool HazardCheck::ordered(const Access& access, GLbitfield bit) {
    int first = -1, count = 0;
    for (const auto& [index, given] : access.since) {
        if (!(given & bit)) continue;
        if (count++ == 0) first = index - first_barrier_;
    }
    if (first >= 0) {
        barriers_[size_t(first)].used |= bit;
        if (count == 1) barriers_[size_t(first)].needed |= bit;
    }
    return count > 0;
}

std::string HazardCheck::text_of(const MemoryRange& range) const {
    if (describe) return describe(range);
    return fmt::format("{} {}", range.is_buffer ? "buffer" : "texture", range.object);
}

void HazardCheck::report(const std::string& hazard) {
    if (!told_.insert(hazard).second) return;
    hazards_.push_back(hazard);
    if (on_hazard) on_hazard(hazard);
}

void HazardCheck::check(const MemoryCommand& command, const MemoryUse& use) {
    auto found = memory_.find({use.range.is_buffer, use.range.object});
    if (found == memory_.end()) return;
    const GLbitfield bit = barrier_bit(use.route);
    auto tell = [&](const Access& before, const char* what, const char* did) {
        report(fmt::format("{} {} {} by {} after {} {} it: {} is missing between them", command.place, what,
                           text_of(use.range), route_of(use), before.by, did, entry(use.route).barrier));
    };
    for (const Access& store : found->second.stores)
        if (store.range.overlaps(use.range) && !ordered(store, bit))
            tell(store, use.writes ? (use.reads ? "reads and writes" : "overwrites") : "reads", "wrote");
    if (!use.stores()) return;
    for (const Access& read : found->second.reads)
        if (read.range.overlaps(use.range) && !ordered(read, bit)) tell(read, "overwrites", "read");
}

void HazardCheck::check_feedback(const MemoryCommand& command) {
    for (size_t i = 0; i < command.uses.size(); ++i) {
        for (size_t j = 0; j < command.uses.size(); ++j) {
            const MemoryUse &writer = command.uses[i], &other = command.uses[j];
            if (i == j || !writer.writes || (other.writes && j < i) || !writer.range.overlaps(other.range)) continue;
            report(fmt::format("{} writes {} by {} and {} it by {}: nothing orders the two within a command",
                               command.place, text_of(other.range), route_of(writer), other.writes ? "writes" : "reads",
                               route_of(other)));
        }
    }
}

void HazardCheck::command(const MemoryCommand& command) {
    if (trace) trace->push_back({command, 0, ""});
    check_feedback(command);
    for (const MemoryUse& use : command.uses)
        check(command, use);
    for (const MemoryUse& use : command.uses) {
        std::string by = fmt::format("{} by {}", command.place, route_of(use));
        if (use.stores()) record(memory_[{use.range.is_buffer, use.range.object}].stores, use.range, by);
        // A store that reads as well (an atomic) is in `stores`, which asks for more.
        else if (use.reads && use.by_shader())
            record(memory_[{use.range.is_buffer, use.range.object}].reads, use.range, by);
    }
}

void HazardCheck::barrier(GLbitfield bits, const std::string& place) {
    if (trace) trace->push_back({{}, bits, place});
    if (barriers_.size() >= k_max_barriers) forget_barriers(); // a window runs for hours
    const int index = first_barrier_ + int(barriers_.size());
    barriers_.push_back({bits, place, 0, 0});
    for (auto& [object, memory] : memory_) {
        give(memory.stores, index, bits);
        give(memory.reads, index, bits);
    }
}

std::string HazardCheck::barrier_report() const {
    std::map<std::string, bool> places; // whether one of its barriers was needed
    for (const Barrier& barrier : barriers_)
        places[barrier.place] |= barrier.needed != 0;
    std::vector<std::string> idle;
    for (const auto& [place, needed] : places)
        if (!needed) idle.push_back(place);
    std::string text = fmt::format("{} memory barriers at {} places", barriers_.size(), places.size());
    if (!idle.empty()) text += fmt::format(", {} of which no command needed: {}", idle.size(), join(idle, "; "));
    return text;
}

void HazardCheck::forget_barriers() {
    first_barrier_ += int(barriers_.size());
    barriers_.clear();
}

void HazardCheck::forget(GLuint object, bool is_buffer) {
    memory_.erase({is_buffer, object});
}

} // namespace bounce
