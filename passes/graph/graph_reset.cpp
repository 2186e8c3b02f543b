// The part of Graph that outlives its context.
#include "core/log.h"
#include "graph/graph.h"

#include <fmt/format.h>

namespace bounce {

void Graph::release_gpu() {
    counters_.drop();
    timings_ = Timings(timer_mode_);
    allocations_.release();
    neutrals_.clear();
    nan_check_.reset();
    empty_buffer_ = {};
    comparison_sampler_ = {};
    empty_vertex_array_ = {};
    for (const auto& node : model_->nodes())
        for (const auto& program : node->programs)
            program->release();
}

void Graph::restore_gpu(ResetCause cause) {
    const std::string lost_in = std::exchange(lost_in_, {});
    if (PassNode* node = model_->find_node(lost_in)) {
        for (const auto& program : node->programs)
            disable_programs(program->files(), fmt::format("the GPU was reset while pass '{}' ran", lost_in));
    } else if (!edited_files_.empty() && (cause == ResetCause::guilty || cause == ResetCause::unknown)) {
        disable_programs(edited_files_, "the GPU was reset, and it was compiled last");
    }
    edited_files_.clear();
    make_objects();
    if (planned_) allocations_.update(plan_);
    for (const auto& node : model_->nodes())
        for (const auto& program : node->programs)
            program->restore();
    invalidation_ = {};
    if (planned_) invalidation_.new_plan(*model_, plan_);
    dirty_ = true;
    constexpr int k_watched = 3; // what hung once, hangs at once again
    watched_frames_ = k_watched;
}

void Graph::disable_programs(const std::vector<std::filesystem::path>& files, const std::string& why) {
    for (const auto& node : model_->nodes()) {
        for (const auto& program : node->programs) {
            if (program->files() != files || program->disabled()) continue;
            program->disable(why);
            spdlog::warn("pass '{}': {} is disabled: {}", node->id(), program->stages().front().string(), why);
            std::string text;
            for (const ShaderSource& source : program->sources())
                text += source.text + '\0';
            built_[node->id() + "/" + program->name()] = {text, program->errors()};
        }
    }
}

} // namespace bounce
