#include "graph/graph.h"

#include "core/error.h"
#include "core/log.h"
#include "core/problem.h"
#include "core/text.h"
#include "gpu/device_memory.h"
#include "graph/graph_overlay.h"
#include "graph/plan_memory.h"
#include "graph/plan_needs.h"
#include "graph/shader_log.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <utility>

namespace bounce {

Graph::Graph(const std::filesystem::path& file, TimerMode timer_mode)
    : model_(std::make_unique<GraphModel>(read_graph_file(file))), timer_mode_(timer_mode), timings_(timer_mode) {
#ifdef BOUNCE_DEBUG
    check_nan = true;
#endif
    make_objects();
    watch();
}

Graph::~Graph() = default;

/// What every graph has of its own, whatever its plan.
void Graph::make_objects() {
    empty_buffer_ = Buffer(1024, nullptr, "nothing");
    empty_buffer_.clear();
    comparison_sampler_ = Sampler(GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, "depth comparison");
    glSamplerParameteri(comparison_sampler_.id(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(comparison_sampler_.id(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    empty_vertex_array_ = VertexArray("no attributes");
}

void Graph::watch() {
    std::vector<std::filesystem::path> files = model_->files();
    files.insert(files.end(), broken_chain_.begin(), broken_chain_.end());
    watch_.watch(files);
}

// --- planning --------------------------------------------------------------------------------------------------------

static bool same_needs(const SceneFacts& a, const SceneFacts& b) {
    auto key = [](const SceneFacts& f) {
        return std::make_tuple(f.triangles, f.instances, f.dynamic_instances, f.glossy_materials, f.emissive_materials,
                               f.alpha_tested_materials, f.blended_materials, f.point_lights, f.spot_lights,
                               f.directional_lights, f.animated_lights, f.environment, f.materials);
    };
    return key(a) == key(b);
}

/// What passes asked for when they declared what they make.
static bool same_facts_read(const Plan& plan, const SceneFacts& a, const SceneFacts& b) {
    for (const PlanPass& pass : plan.passes) {
        for (auto [offset, size] : pass.facts_read) {
            const auto* of_a = reinterpret_cast<const char*>(&a) + offset;
            if (std::memcmp(of_a, reinterpret_cast<const char*>(&b) + offset, size) != 0) return false;
        }
    }
    return true;
}

static std::vector<bool> switches_of(const GraphModel& model) {
    std::vector<bool> switches;
    for (const auto& node : model.nodes())
        switches.push_back(node->enabled);
    return switches;
}

bool Graph::needs_plan(const SceneFacts& facts, glm::ivec2 size) {
    bool needed = std::exchange(dirty_, false);
    for (const std::string& name : model_->take_changes()) {
        // What hung with the old value may do with the new one.
        if (PassNode* node = model_->find_node(name.substr(0, name.find('.')))) {
            for (const auto& program : node->programs) {
                needed = needed || program->disabled();
                program->enable();
            }
        }
        const Parameter* set = model_->find_parameter(name);
        // In C++ a parameter may shape what a pass declares; a static one, which slots its shader has.
        bool plain = set && set->info.in_shader && !set->info.is_static && !plan_.numbers.contains(name);
        needed = needed || !plain || !plan_problem_.empty();
    }
    return needed || !planned_ || plan_.size != size || !same_needs(facts, planned_facts_) ||
           !same_facts_read(plan_, facts, planned_facts_) || switches_of(*model_) != planned_switches_;
}

void Graph::prepare(const SceneFacts& facts, glm::ivec2 size) {
    if (!needs_plan(facts, size)) return;
    // What was counted with buffers that were too small is void: it would make them grow once more.
    if (std::exchange(needs_larger_buffers_, false)) counters_.drop();
    try {
        plan_again(facts, size);
        plan_problem_.clear();
    } catch (const std::exception& problem) {
        if (!planned_) throw;
        std::string text = problem_text(problem);
        if (plan_problem_ != text) spdlog::error("{}", text);
        plan_problem_ = text;
    }
    planned_switches_ = switches_of(*model_);
    build_programs();
    invalidation_.new_plan(*model_, plan_);
    watch();
}

void Graph::set_default_rebuild(Rebuild rebuild) {
    default_rebuild_ = rebuild;
    model_->set_default_rebuild(rebuild);
}

void Graph::plan_again(const SceneFacts& facts, glm::ivec2 size) {
    ++plans_;
    Plan next = model_->plan(facts, size);
    check_plan_fits(*model_, facts, next, planned_ ? plan_.total_bytes() : 0);
    try {
        allocations_.update(next);
    } catch (const OutOfDeviceMemory& problem) {
        throw Error(out_of_memory_text(*model_, facts, next, problem.what()));
    }
    neutrals_.clear(); // they are as large as what they stand for
    plan_ = std::move(next);
    planned_facts_ = facts;
    planned_ = true;
}

std::vector<std::string> Graph::check_interface(const PassNode& node, const PlanPass& pass,
                                                const ProgramInterface& interface) const {
    std::vector<std::string> problems;
    std::vector<std::string> constants;
    for (const FrameConstant& known : frame_constants())
        constants.push_back(known.name);
    constants.insert(constants.end(), {"iteration", "repeat_from", "repeat_to"});
    constants.insert(constants.end(), node.description->constants.begin(), node.description->constants.end());
    for (const UniformInfo& uniform : interface.uniforms) {
        bool known = std::find(constants.begin(), constants.end(), uniform.name) != constants.end();
        const Parameter* parameter = model_->parameter_of(node, uniform.name);
        const FrameConstant* constant = find_frame_constant(uniform.name);
        if (constant && !frame_constant_fits(*constant, uniform.type)) {
            problems.push_back(fmt::format("uniform '{}' is a constant of the frame, of another type (see "
                                           "lib/frame.glsl)",
                                           uniform.name));
        }
        if (!known && parameter && !uniform_takes(uniform.type, parameter->value)) {
            problems.push_back(
                fmt::format("uniform '{}' and the parameter of that name are of different types", uniform.name));
        }
        if (known || parameter) continue;
        std::vector<std::string> names = node.parameters.names();
        names.insert(names.end(), constants.begin(), constants.end());
        problems.push_back(
            fmt::format("uniform '{0}' has no source{1}; to make it a parameter write: uniform … {0} = …;  //! "
                        "[least, greatest] what it is",
                        uniform.name, did_you_mean(uniform.name, names)));
    }
    auto check_slot = [&](const std::string& identifier) {
        if (!pass.find(slot_name(identifier)) && !identifier.starts_with("scene_") &&
            !identifier.starts_with("material_")) {
            problems.push_back(fmt::format("'{}' is no slot of pass '{}'", slot_name(identifier), pass.id));
        }
    };
    for (const OpaqueInfo& sampler : interface.samplers)
        check_slot(sampler.name);
    for (const OpaqueInfo& image : interface.images)
        check_slot(image.name);
    for (const BlockInfo& block : interface.storage_blocks)
        check_slot(block.name);
    for (const BlockInfo& block : interface.uniform_blocks) {
        problems.push_back("uniform block '" + block.name +
                           "' has no source: constants of the frame are plain uniforms (see lib/frame.glsl)");
    }
    return problems;
}

static std::vector<std::string> texts(const std::vector<ShaderError>& errors) {
    std::vector<std::string> out;
    for (const ShaderError& error : errors)
        out.push_back(error.text());
    return out;
}

void Graph::build_programs() {
    for (const PlanPass& pass : plan_.passes) {
        PassNode& node = *model_->nodes()[size_t(pass.node)];
        model_->scan(node, pass_defines(plan_, pass));
        for (const auto& program : node.programs) {
            if (!pass.runs(program->name())) continue;
            std::string text;
            for (const ShaderSource& source : program->sources())
                text += source.text + '\0';
            Built& built = built_[node.id() + "/" + program->name()];
            bool judged = program->usable() || program->disabled() || !built.errors.empty();
            const bool read = program->errors().empty();
            if (built.text == text && read && built.read && judged) {
                program->recall(built.errors); // what was wrong with this text still is
                continue;
            }
            bool good = program->build([&](const ProgramInterface& i) { return check_interface(node, pass, i); });
            if (good && frames_ > 0) {
                edited_files_ = program->files();
                watched_frames_ = std::max(watched_frames_, 1); // its first
            }
            bool told = built.text == text && texts(built.errors) == texts(program->errors());
            for (const ShaderError& error : program->errors())
                if (!told && shader_errors_logged()) spdlog::error("shader: {}", error.text());
            built = {text, program->errors(), read};
            if (good && frames_ > 0) spdlog::info("shader: {} compiled", program->stages().front().string());
        }
    }
}

// --- reloading -------------------------------------------------------------------------------------------------------

bool Graph::poll_files() {
    std::vector<std::filesystem::path> changed = watch_.poll();
    if (changed.empty()) return false;
    dirty_ = true;
    auto is_of = [&](const std::vector<std::filesystem::path>& files) {
        return std::find_first_of(changed.begin(), changed.end(), files.begin(), files.end()) != changed.end();
    };
    if (is_of(model_->file().files) || is_of(broken_chain_)) {
        broken_chain_ = graph_chain(model_->file().path);
        try {
            auto next = std::make_unique<GraphModel>(read_graph_file(model_->file().path));
            next->set_default_rebuild(default_rebuild_);
            next->adopt_values(model_->values());
            next->adopt_programs(*model_);
            try {
                Plan plan = next->plan(planned_facts_, plan_.size);
                check_plan_fits(*next, planned_facts_, plan, plan_.total_bytes());
                try {
                    allocations_.update(plan);
                } catch (const OutOfDeviceMemory& problem) {
                    throw Error(out_of_memory_text(*next, planned_facts_, plan, problem.what()));
                }
                plan_ = std::move(plan);
                invalidation_.new_plan(*next, plan_);
            } catch (...) {
                model_->adopt_programs(*next); // the old graph goes on as it was
                throw;
            }
            model_ = std::move(next);
            file_problem_.clear();
            broken_chain_.clear();
            plan_problem_.clear();
            spdlog::info("graph '{}' reloaded", model_->file().name);
        } catch (const std::exception& problem) {
            file_problem_ = problem_text(problem);
            spdlog::error("{}", file_problem_);
        }
    }
    for (const auto& node : model_->nodes()) {
        bool touched = false;
        for (const auto& program : node->programs) {
            const auto& files = program->files();
            bool reads_one = std::any_of(changed.begin(), changed.end(), [&](auto& file) {
                return std::find(files.begin(), files.end(), file) != files.end();
            });
            if (reads_one) program->files_changed();
            touched = touched || reads_one;
        }
        if (touched) model_->scan(*node);
    }
    return true;
}

std::vector<GraphProblem> Graph::problems() const {
    std::vector<GraphProblem> problems;
    auto graph_problem = [&](const std::string& text) {
        if (!text.empty()) problems.push_back({"graph", {model_->file().path.filename(), 0, "", text}});
    };
    graph_problem(file_problem_);
    graph_problem(plan_problem_);
    for (const auto& [id, why] : broke_)
        problems.push_back({"pass " + id, {model_->file().path.filename(), 0, "", why}});
    for (const auto& node : model_->nodes()) {
        for (const auto& program : node->programs) {
            if (program->disabled()) {
                problems.push_back({"pass " + node->id(),
                                    {program->stages().front(), 0, "",
                                     fmt::format("disabled: {}; edit it, or set a parameter of the pass, to try again",
                                                 program->why_disabled())}});
            }
            for (const ShaderError& error : program->errors())
                problems.push_back({"pass " + node->id(), error});
        }
    }
    return problems;
}

bool Graph::pass_is_stale(const std::string& id) const {
    auto pass = std::find_if(plan_.passes.begin(), plan_.passes.end(), [&](auto& p) { return p.id == id; });
    if (pass == plan_.passes.end()) return false;
    const auto& programs = model_->nodes()[size_t(pass->node)]->programs;
    return std::any_of(programs.begin(), programs.end(),
                       [&](auto& p) { return pass->runs(p->name()) && (!p->errors().empty() || !p->usable()); });
}

// --- looking ---------------------------------------------------------------------------------------------------------

double Graph::frame_ms() const {
    double sum = 0;
    for (const PlanPass& pass : plan_.passes) {
        PassTiming timing = this->timing(pass.id);
        sum += model_->rebuild() == Rebuild::every_frame ? timing.median : timing.per_frame;
    }
    return sum;
}

const GpuTexture* Graph::texture(const std::string& resource) const {
    for (size_t i = 0; i < plan_.resources.size(); ++i) {
        const PlanResource& known = plan_.resources[i];
        if (known.name() == resource && !known.is_buffer()) return &allocations_.texture(int(i));
    }
    return nullptr;
}

const Buffer* Graph::buffer(const std::string& resource) const {
    for (size_t i = 0; i < plan_.resources.size(); ++i) {
        const PlanResource& known = plan_.resources[i];
        if (known.name() == resource && known.is_buffer()) return &allocations_.buffer(int(i));
    }
    return nullptr;
}

} // namespace bounce
