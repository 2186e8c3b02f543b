#include "app/experiments/variant.h"

#include "app/broken_shaders.h"
#include "app/capture.h"
#include "app/experiments/flicker.h"
#include "app/experiments/transport.h"
#include "core/comparison.h"
#include "core/error.h"
#include "core/text.h"
#include "graph/shader_log.h"
#include "reference/reference_image.h"

#include <cmath>
#include <utility>

namespace bounce {

namespace {

constexpr int k_warm_up = 1; ///< programs are compiled, and lists grow to what they hold

bool stands_still(const Session& session) {
    const Shot& shot = session.shot();
    bool moves = !shot.camera_path.keys.empty() || session.facts().dynamic_instances > 0;
    for (const Node& node : shot.scene.nodes)
        moves |= !node.path.keys.empty();
    return !moves;
}

} // namespace

std::string Variant::text() const {
    std::vector<std::string> parts;
    for (const auto& [name, value] : sets)
        parts.push_back(name + "=" + value);
    for (const auto& [pass, on] : switches)
        parts.push_back(pass + (on ? " on" : " off"));
    return parts.empty() ? "as it is" : join(parts, ", ");
}

void set_parameters(GraphModel& model, const std::map<std::string, std::string>& sets,
                    const std::function<void(const std::string&)>& before) {
    std::map<std::string, std::string> open = sets;
    for (bool found = true; found;) {
        found = false;
        for (auto it = open.begin(); it != open.end();) {
            if (!model.find_parameter(it->first)) {
                ++it;
                continue;
            }
            if (before) before(it->first);
            model.set(it->first, it->second, ParameterOrigin::command_line);
            it = open.erase(it);
            found = true;
        }
    }
    if (!open.empty()) model.parameter(open.begin()->first); // throws, with the nearest name
}

VariantMeasurer::VariantMeasurer(const SessionOptions& options, int samples, int frames) : frames_(frames) {
    set_shader_errors_logged(false);
    session_ = std::make_unique<Session>(options);
    throw_if_broken(*session_, "nothing was measured");
    still_ = stands_still(*session_);
    const GraphModel& model = session_->graph().model();
    for (const auto& node : model.nodes())
        own_switches_[node->id()] = node->enabled;
    const Transport& transport = model.file().transport;
    parts_ = join(transport.parts, "+");
    ReferenceSettings settings = transport_settings(model);
    if (only_occlusion(transport.parts)) settings.bounces = 0; // it has none
    Shot shot = load_shot(options.shot);
    shot.width = session_->size().x;
    shot.height = session_->size().y;
    ReferenceGoal goal;
    goal.samples = samples;
    goal.noise = 0;
    const int frame = still_ ? 0 : k_warm_up + frames - 1;
    truth_ = reference_image(shot, settings, frame, goal, [](const ReferenceProgress&) { return true; }).image;
    truth_part_ = part_of(truth_, parts_, "the reference");
}

VariantMeasurer::~VariantMeasurer() = default;

void VariantMeasurer::use(const Variant& variant) {
    GraphModel& model = session_->graph().model();
    for (auto& node : model.nodes())
        node->enabled = own_switches_.at(node->id());
    // Back by their own origin, so that what the file derives from them follows. What a choice brought may be gone.
    for (const auto& [name, own] : std::exchange(own_sets_, {}))
        if (model.find_parameter(name)) model.set(name, own.text, own.origin);
    const auto note_own = [&](const std::string& name) {
        if (const Parameter* p = model.find_parameter(name)) own_sets_.emplace(name, Own{p->text(), p->origin});
    };
    for (const auto& [name, text] : variant.sets)
        note_own(name);
    set_parameters(model, variant.sets, note_own); // one may come with another's choice
    for (const auto& [pass, on] : variant.switches)
        model.switch_pass(pass, on);
    session_->graph().touch();
    session_->graph().reset_history();
}

VariantFigures VariantMeasurer::measure(const Variant& variant) {
    use(variant);
    session_->set_frame(0);
    VariantFigures figures;
    ComparisonOptions comparison;
    comparison.parts = {parts_};
    comparison.absent_is_black = true;
    comparison.shown = false;
    std::vector<double> errors;
    SecondDifference flicker;
    for (int frame = 0; frame < k_warm_up + frames_; ++frame) {
        if (frame > 0) session_->advance();
        if (frame == k_warm_up) session_->graph().forget_timings();
        session_->render(true);
        const bool last = frame + 1 == k_warm_up + frames_;
        if (frame < k_warm_up) continue;
        throw_if_broken(*session_, variant.text());
        const LayeredImage picture = read_parts(*session_);
        flicker.add(luminance_of(part_or_black(picture, parts_, truth_part_)));
        if (!still_ && !last) continue;
        const LayerComparison compared = compare_layers(picture, truth_, comparison);
        const MetricValues& values = compared.parts.front().figures;
        errors.push_back(values["relative_rmse_denoised"]);
        figures.bias = values["bias"];
        if (last) figures.picture = part_or_black(picture, parts_, truth_part_);
    }
    figures.flicker = flicker.flicker();
    session_->graph().finish_timings();
    figures.ms = session_->graph().frame_ms();
    figures.bytes = session_->graph().plan().total_bytes();
    for (double error : errors)
        figures.error += error / double(errors.size());
    for (double error : errors)
        figures.error_spread += std::pow(error - figures.error, 2);
    figures.error_spread = std::sqrt(figures.error_spread / double(std::max<size_t>(errors.size(), 2) - 1));
    return figures;
}

} // namespace bounce
