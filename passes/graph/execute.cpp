// The part of Graph that runs a frame.
#include "core/error.h"
#include "core/log.h"
#include "core/problem.h"
#include "gpu/barrier.h"
#include "gpu/capabilities.h"
#include "graph/graph.h"

#include <algorithm>
#include <utility>

namespace bounce {

/// The state that every pass starts from.
static void default_state() {
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_DEPTH_CLAMP);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

bool Graph::execute(const FrameInputs& inputs, const BetweenPasses& between) {
    if (!planned_) throw Error("the graph has no plan yet");
    inputs_ = &inputs;
    bool all = model_->rebuild() == Rebuild::every_frame || (check_nan && !checked_nan_);
    checked_nan_ = check_nan;
    if (!check_nan) non_finite_.clear();
    invalidation_.begin_frame(*model_, plan_, allocations_, inputs, all);
    for (int resource : invalidation_.voids())
        allocations_.reset(plan_, resource);
    failed_.clear();
    const auto steps_of = [&](size_t i) {
        return invalidation_.runs(i) ? std::max(plan_.passes[i].repeat_to - plan_.passes[i].repeat_from, 1) : 0;
    };
    int done = 0, all_steps = 0;
    for (size_t i = 0; i < plan_.passes.size(); ++i)
        all_steps += steps_of(i);
    const auto goes_on = [&](int steps) {
        done += steps;
        return !between || steps == 0 || done >= all_steps || between(float(done) / float(all_steps));
    };
    for (size_t i = 0; i < plan_.passes.size();) {
        size_t last = i;
        const std::string& loop = plan_.passes[i].loop;
        while (!loop.empty() && last + 1 < plan_.passes.size() && plan_.passes[last + 1].loop == loop)
            ++last;
        // One pass with all its steps, or the passes of a loop step by step.
        const bool cut = !loop.empty() || (between && steps_of(i) > 1);
        if (!cut) run_pass(i, plan_.passes[i].repeat_from, plan_.passes[i].repeat_to, false);
        if (cut ? !run_steps(i, last, goes_on) : !goes_on(steps_of(i))) {
            for (size_t left = i; cut && left <= last; ++left)
                timings_.drop(plan_.passes[left].id);
            invalidation_.cut_short(plan_, i, last);
            end_execution();
            return false;
        }
        i = last + 1;
    }
    std::erase_if(broke_, [&](const auto& broken) {
        return std::none_of(plan_.passes.begin(), plan_.passes.end(), [&](auto& p) { return p.id == broken.first; });
    });
    memory_barrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT); // the copies wait for shaders' stores
    for (int resource : invalidation_.end_frame(plan_))
        allocations_.keep_previous(resource);
    if (counters_.collect(plan_, allocations_)) ask_for_larger_buffers();
    end_execution();
    watched_frames_ = std::max(watched_frames_ - 1, 0);
    ++frames_;
    return true;
}

void Graph::end_execution() {
    memory_barrier(GL_ALL_BARRIER_BITS); // whoever looks at the results (panels, readback) sees them
    default_state();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glUseProgram(0);
    inputs_ = nullptr;
}

/// Of a pass, or of the passes of a loop. Returns false when `goes_on`, which is asked after each, does.
bool Graph::run_steps(size_t first, size_t last, const std::function<bool(int)>& goes_on) {
    const PlanPass& head = plan_.passes[first];
    for (int step = head.repeat_from; step < head.repeat_to; ++step) {
        // What one of them reads, or overwrites, any other may have touched in the step before.
        if (step > head.repeat_from) memory_barrier(head.loop.empty() ? head.step_barriers : GL_ALL_BARRIER_BITS);
        for (size_t i = first; i <= last; ++i) {
            run_pass(i, step, step + 1, true);
            if (!goes_on(invalidation_.runs(i) ? 1 : 0)) return false;
        }
    }
    return true;
}

/// `cut`: it is timed step by step, since something may happen between them.
void Graph::run_pass(size_t index, int from, int to, bool cut) {
    if (!lost_in_.empty()) return; // nothing can run any more
    const PlanPass& pass = plan_.passes[index];
    bool first = from == pass.repeat_from, last = to >= pass.repeat_to;
    if (!invalidation_.runs(index)) {
        // Whoever comes after it counts on its barrier.
        if (pass.barriers) memory_barrier(pass.barriers);
        if (first) timings_.skip(pass.id);
        return;
    }
    PassNode& node = *model_->nodes()[size_t(pass.node)];
    DebugGroup group(pass.id);
    size_t step = cut ? size_t(from - pass.repeat_from) : 0;
    timings_.begin(pass.id, step, cut ? size_t(std::max(pass.repeat_to - pass.repeat_from, 1)) : 1);
    bool usable = std::all_of(node.programs.begin(), node.programs.end(),
                              [&](auto& p) { return p->usable() || !pass.runs(p->name()); });
    if (first) {
        for (int resource : pass.clears)
            allocations_.clear(resource, plan_.resources[size_t(resource)].declaration.neutral);
    }
    if (pass.barriers) memory_barrier(pass.barriers);
    bool whole = usable && !failed_.contains(pass.id); // by a step before this one
    if (whole) {
        try {
            for (int i = from; i < to; ++i) {
                if (i > from && pass.step_barriers) memory_barrier(pass.step_barriers);
                default_state();
                PassContext context(*this, pass, invalidation_.inputs(pass.id), i);
                node.pass->execute(context);
            }
            broke_.erase(pass.id);
        } catch (const std::exception& problem) {
            std::string text = problem_text(problem);
            if (broke_[pass.id] != text) spdlog::error("pass '{}': {}", pass.id, text);
            broke_[pass.id] = text;
            whole = false;
            failed_.insert(pass.id);
            fill_failed(pass);
        }
    } else if (!usable) {
        fill_failed(pass);
    }
    timings_.end(pass.id, step);
    if (watched_frames_ > 0) {
        glFinish();
        if (context_is_lost()) lost_in_ = pass.id;
    }
    if (last) invalidation_.ran(index, *model_, plan_, allocations_, *inputs_, whole);
    if (check_nan) look_for_nan(pass);
}

void Graph::ask_for_larger_buffers() {
    for (const PlanPass& pass : plan_.passes) {
        std::vector<int64_t> counted;
        for (const CounterValue& counter : counters_.newest())
            if (counter.pass == pass.id) counted.push_back(counter.value);
        if (counted.empty() || !model_->nodes()[size_t(pass.node)]->pass->needs_larger_buffers(counted)) continue;
        dirty_ = true;
        needs_larger_buffers_ = true;
    }
}

bool Graph::needs_larger_buffers() {
    if (counters_.finish()) ask_for_larger_buffers();
    return std::exchange(needs_larger_buffers_, false);
}

void Graph::forget_timings() {
    finish_timings();
    timings_.forget();
}

void Graph::finish_timings() {
    glFinish();
    counters_.finish();
    timings_.take();
}

/// A pass whose program never compiled: its float colour outputs turn magenta, the others neutral.
void Graph::fill_failed(const PlanPass& pass) {
    for (const PlanSlot& slot : pass.slots) {
        if (slot.resource < 0 || !slot.use.writes) continue;
        const PlanResource& resource = plan_.resources[size_t(slot.resource)];
        bool colour = false;
        if (!resource.is_buffer()) {
            const Format& format = format_by_enum(resource.texture.format);
            colour = format.channels >= 3 && !format.is_integer() && !format.is_depth();
        }
        allocations_.clear(slot.resource, colour ? glm::vec4(1, 0, 1, 1) : resource.declaration.neutral);
    }
}

void Graph::look_for_nan(const PlanPass& pass) {
    if (!nan_check_) nan_check_ = std::make_unique<NanCheck>();
    for (const PlanSlot& slot : pass.slots) {
        if (slot.resource < 0 || !slot.use.writes || plan_.resources[size_t(slot.resource)].is_buffer()) continue;
        const PlanResource& resource = plan_.resources[size_t(slot.resource)];
        uint64_t count = nan_check_->count(allocations_.texture(slot.resource));
        non_finite_.erase(resource.name());
        if (!count) continue;
        non_finite_[resource.name()] = count;
        spdlog::warn("pass '{}' wrote {} values to '{}' that are not finite", pass.id, count, resource.name());
    }
}

static TextureKind kind_of_sampler(GLenum type) {
    switch (type) {
    case GL_SAMPLER_3D:
    case GL_INT_SAMPLER_3D:
    case GL_UNSIGNED_INT_SAMPLER_3D:
        return TextureKind::texture_3d;
    case GL_SAMPLER_2D_ARRAY:
    case GL_SAMPLER_2D_ARRAY_SHADOW:
    case GL_INT_SAMPLER_2D_ARRAY:
    case GL_UNSIGNED_INT_SAMPLER_2D_ARRAY:
        return TextureKind::texture_2d_array;
    default:
        return TextureKind::texture_2d;
    }
}

static GLenum neutral_format(GLenum type) {
    switch (type) {
    case GL_UNSIGNED_INT_SAMPLER_2D:
    case GL_UNSIGNED_INT_SAMPLER_3D:
    case GL_UNSIGNED_INT_SAMPLER_2D_ARRAY:
        return GL_RGBA32UI;
    case GL_INT_SAMPLER_2D:
    case GL_INT_SAMPLER_3D:
    case GL_INT_SAMPLER_2D_ARRAY:
        return GL_R32I;
    case GL_SAMPLER_2D_SHADOW:
    case GL_SAMPLER_2D_ARRAY_SHADOW:
        return GL_DEPTH_COMPONENT32F;
    default:
        return GL_RGBA16F;
    }
}

GLuint Graph::neutral_texture(GLenum type, glm::vec4 value, glm::ivec2 size) {
    // 2D ones are as large as what they stand for, so that a fetch finds the value at every texel; a byte a texel does,
    // since zeros and ones come from the swizzle. Volumes and arrays have one texel: they are read through a filter.
    TextureDesc desc{kind_of_sampler(type), neutral_format(type), {1, 1, 1}, 1};
    bool plain = desc.format == GL_RGBA16F;
    for (int i = 0; i < 4; ++i)
        plain = plain && (value[i] == 0 || value[i] == 1);
    if (plain) desc.format = GL_R8;
    if (desc.kind == TextureKind::texture_2d) desc.size = glm::ivec3(size, 1);
    auto key = std::make_tuple(type, std::array<float, 4>{value.x, value.y, value.z, value.w},
                               std::array<int, 2>{size.x, size.y});
    auto found = neutrals_.find(key);
    if (found == neutrals_.end()) {
        GpuTexture texture(desc, "neutral");
        texture.clear(value);
        if (plain) {
            GLint swizzle[4];
            for (int i = 0; i < 4; ++i)
                swizzle[i] = value[i] == 0 ? GL_ZERO : GL_ONE;
            glTextureParameteriv(texture.id(), GL_TEXTURE_SWIZZLE_RGBA, swizzle);
        }
        found = neutrals_.emplace(key, std::move(texture)).first;
    }
    return found->second.id();
}

} // namespace bounce
