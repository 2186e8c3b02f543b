#include "app/session.h"

#include "app/omitted_light.h"
#include "core/digest.h"
#include "core/error.h"
#include "core/limits.h"
#include "core/log.h"
#include "core/text.h"
#include "gpu/device_memory.h"
#include "reference/scene_needs.h"
#include "scene/describe.h"
#include "scene/pre_exposure.h"

#include <fmt/format.h>

namespace bounce {

void apply_options(GraphModel& model, const SessionOptions& options) {
    ErrorList errors;
    for (const auto& [name, text] : options.sets) {
        try {
            model.set(name, text, ParameterOrigin::command_line);
        } catch (const Error& error) {
            errors.add(error.what());
        }
    }
    errors.throw_if_any("--set");
    for (const auto& [id, on] : options.switches)
        model.switch_pass(id, on);
    if (!options.resource.empty()) model.ask_for(options.resource);
}

Session::Session(SessionOptions options) : options_(std::move(options)), timer_mode_(probe_timer_mode()) {
    shot_ = std::make_unique<Shot>(load_shot(options_.shot));
    if (options_.material_model) shot_->material_model = *options_.material_model;
    size_ = options_.size.value_or(glm::ivec2(shot_->width, shot_->height));
    graph_ = make_graph(options_.graph);
    apply_options(graph_->model(), options_);
    load_scene_to_gpu();
    resolve_auto(graph_->model());
    graph_->prepare(facts_, size_); // so that a bad graph is told at once
    log_omitted_light(options_.graph, graph_->model().file().transport, facts_);
}

Session::~Session() = default;

std::unique_ptr<Graph> Session::make_graph(const std::string& name) const {
    auto graph = std::make_unique<Graph>(find_graph(name), timer_mode_);
    graph->check_nan = graph->check_nan || options_.check_nan;
    graph->set_default_rebuild(options_.rebuild);
    return graph;
}

/// Bytes that a scene takes on the GPU: geometry, and textures with their mips.
static double scene_bytes(const Scene& scene) {
    double bytes = double(scene.vertices.size()) * sizeof(Vertex) + double(scene.indices.size()) * sizeof(uint32_t);
    for (const Texture& texture : scene.textures)
        bytes += double(texture.image.rgba.size()) * 4 / 3;
    return bytes;
}

static void check_scene_fits(const Shot& shot) {
    const double needed = scene_bytes(shot.scene);
    const uint64_t free = available_device_memory();
    if (needed <= double(free)) return;
    throw Error(fmt::format("{}: {} triangles and {} textures need {} of memory on the GPU, but {} are free: use a "
                            "smaller scene",
                            shot.path.string(), grouped(shot.scene.indices.size() / 3), shot.scene.textures.size(),
                            format_bytes(needed), format_bytes(double(free))));
}

void Session::load_scene_to_gpu() {
    facts_ = shot_facts(*shot_);
    check_scene_fits(*shot_);
    if (std::string strays = describe_strays(facts_); !strays.empty()) spdlog::warn("{}: {}", shot_->name, strays);
    gpu_scene_ = std::make_unique<GpuScene>(shot_->scene, shot_->environment);
    rendered_frame_ = -1;
    scene_edited();
    has_last_view_ = false;
}

void Session::open_shot(const std::string& name) {
    auto next = std::make_unique<Shot>(load_shot(name));
    std::swap(shot_, next);
    try {
        load_scene_to_gpu();
    } catch (...) {
        std::swap(shot_, next);
        load_scene_to_gpu();
        throw;
    }
    needs_.reset();
    resolve_auto(graph_->model());
    options_.shot = name;
    options_.material_model.reset();
    camera_.reset();
    frame_ = 0;
    graph_->touch();
    graph_->reset_history();
    log_omitted_light(options_.graph, graph_->model().file().transport, facts_);
}

void Session::open_graph(const std::string& name) {
    options_.check_nan = graph_->check_nan; // as it is switched now
    std::unique_ptr<Graph> next = make_graph(name);
    next->model().adopt_values(graph_->model().values());
    resolve_auto(next->model());
    next->prepare(facts_, size_);
    graph_ = std::move(next);
    options_.graph = name;
    log_omitted_light(name, graph_->model().file().transport, facts_);
}

void Session::set_frame(int frame) {
    if (frame != frame_ + 1) graph_->reset_history();
    frame_ = frame;
}

Camera Session::camera() const {
    return camera_ ? *camera_ : evaluate_shot(*shot_, frame_).camera;
}

void Session::set_camera(const Camera& camera, bool cut) {
    camera_ = camera;
    if (!cut) return;
    graph_->reset_history();
    has_last_view_ = false;
    ++camera_cuts_;
}

void Session::follow_shot_camera() {
    camera_.reset();
    has_last_view_ = false;
    ++camera_cuts_;
    graph_->reset_history();
}

void Session::resize(glm::ivec2 size) {
    if (size == size_ || size.x < 1 || size.y < 1) return;
    size_ = size;
    has_last_view_ = false;
}

bool Session::render(bool whole, const BetweenPasses& between) {
    const int frame = frame_; // another may be asked for between two passes, and another camera
    const uint64_t cuts = camera_cuts_;
    state_ = evaluate_shot(*shot_, frame);
    if (scene_dirty_) {
        facts_ = shot_facts(*shot_);
        const float wanted = pre_exposure(state_.scene, shot_->scene.materials, shot_->environment,
                                          facts_.bounds_over_animation.diagonal());
        // What is kept from earlier frames was stored with the old one.
        if (wanted != gpu_scene_->pre_exposure()) graph_->reset_history();
        gpu_scene_->set_pre_exposure(wanted);
        gpu_scene_->update_materials(shot_->scene.materials);
        if (rendered_frame_ >= 0) gpu_scene_->scene_edited(evaluate_shot(*shot_, rendered_frame_).scene);
        scene_dirty_ = false;
    }
    gpu_scene_->update(state_.scene, facts_.animated_lights);
    if (graph_->model().has_auto(true)) resolve_auto(graph_->model()); // its file was read again
    graph_->prepare(facts_, size_);

    FrameConstants& c = constants_;
    c = FrameConstants{};
    bounce::set_camera(c, camera_ ? *camera_ : state_.camera, size_, facts_.bounds_over_animation.diagonal());
    c.previous_view_projection = has_last_view_ ? last_view_projection_ : c.view_projection;
    c.time = state_.time;
    c.delta_time = 1.0f / shot_->fps;
    c.scene_min = facts_.bounds_over_animation.min;
    c.scene_max = facts_.bounds_over_animation.max;
    c.scene_diagonal = facts_.bounds_over_animation.diagonal();
    c.pre_exposure = gpu_scene_->pre_exposure();
    c.environment_radiance = shot_->environment.radiance * c.pre_exposure;
    c.environment_map = shot_->environment.map.empty() ? 0 : 1;
    c.frame_index = frame;
    c.light_count = int(gpu_scene_->light_list().size());
    c.shadow_view_count = gpu_scene_->shadow_view_count();
    c.diffuse_only = shot_->diffuse_only ? 1 : 0;
    c.material_model = int(shot_->material_model);
    c.normal_maps = shot_->normal_maps ? 1 : 0;

    FrameInputs inputs{gpu_scene_.get(), &facts_, c};
    is_whole_ = graph_->execute(inputs, between);
    if (!is_whole_) return false;
    constexpr int k_max_tries = 8; // each grows to what the one before had wanted
    for (int i = 0; whole && i < k_max_tries && graph_->needs_larger_buffers(); ++i) {
        graph_->prepare(facts_, size_);
        graph_->execute(inputs);
    }
    if (context_is_lost()) {
        const std::string& pass = graph_->lost_in();
        throw ContextLost(fmt::format("{} while graph '{}' was rendered{}", to_string(context_reset()), options_.graph,
                                      pass.empty() ? "" : ", in pass '" + pass + "'"));
    }
    last_view_projection_ = c.view_projection;
    has_last_view_ = cuts == camera_cuts_;
    rendered_frame_ = frame;
    return true;
}

float Session::value_scale(const std::string& resource) const {
    const PlanResource* known = graph_->plan().find_resource(resource);
    return known && known->declaration.radiance ? 1 / constants_.pre_exposure : 1.0f;
}

void Session::set_parameter(const std::string& name, const std::string& text, ParameterOrigin origin) {
    graph_->model().set(name, text, origin);
    if (graph_->model().has_auto(true)) resolve_auto(graph_->model());
}

/// Of what a person may move about.
static uint64_t digest_of_places(const Shot& shot) {
    Digest digest;
    for (const Light& light : shot.scene.lights) {
        digest.add(light.type).add(light.enabled).add(light.position).add(light.direction).add(light.intensity);
        digest.add(light.inner_cone).add(light.outer_cone);
    }
    for (const Node& node : shot.scene.nodes)
        if (node.light >= 0) digest.add(node.translation).add(node.rotation);
    for (int node : shot.object_nodes) {
        const Node& object = shot.scene.nodes[size_t(node)];
        digest.add(object.translation).add(object.rotation).add(object.scale);
    }
    for (const PathKey& key : shot.camera_path.keys)
        digest.add(key.t).add(key.position).add(key.target);
    return digest.value();
}

const SceneNeeds& Session::needs() {
    if (!needs_) {
        needs_ = scene_needs(*shot_);
        needs_places_ = digest_of_places(*shot_);
    }
    return *needs_;
}

bool Session::measure_moved_needs() {
    if (!needs_ || digest_of_places(*shot_) == needs_places_) return false;
    needs_.reset();
    resolve_auto(graph_->model());
    return true;
}

void Session::resolve_auto(GraphModel& model) {
    if (model.has_auto()) model.resolve_auto(needs());
}

std::vector<std::pair<std::string, std::string>> Session::changed_parameters(ParameterOrigin at_least) const {
    std::vector<std::pair<std::string, std::string>> changed;
    auto add = [&](const std::string& id, const ParameterSet& set) {
        for (const Parameter& p : set.all()) {
            if (p.origin >= at_least && p.text() != p.info.default_text()) {
                changed.emplace_back(id + "." + p.info.name, to_text(p.info, p.value));
            }
        }
    };
    add("graph", graph_->model().graph_parameters());
    for (const auto& node : graph_->model().nodes())
        add(node->id(), node->parameters);
    return changed;
}

std::string Session::command_line(const std::string& output) const {
    std::string text =
        fmt::format("bounce render {} --graph {} --size {}x{}", options_.shot, options_.graph, size_.x, size_.y);
    if (options_.material_model)
        text += fmt::format(" --material-model {}", k_material_models[size_t(*options_.material_model)]);
    if (frame_ > 0) text += fmt::format(" --frames {}", frame_ + 1);
    std::string options = graph_->model().values().options();
    if (!options.empty()) text += " " + options;
    return text + " -o " + output;
}

void Session::release_gpu() {
    reset_ = context_reset();
    graph_->release_gpu();
    gpu_scene_.reset();
}

void Session::restore_gpu() {
    const uint64_t edits = edits_; // it is the same scene
    load_scene_to_gpu();
    edits_ = edits;
    graph_->restore_gpu(reset_);
}

} // namespace bounce
