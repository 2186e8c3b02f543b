// Renders one point of a chart and compares it with the reference of its own transport and with the full one.
#include "app/broken_shaders.h"
#include "app/capture.h"
#include "app/experiments/chart_point.h"
#include "app/experiments/device_reference.h"
#include "app/experiments/page_picture.h"
#include "app/experiments/transport.h"
#include "app/hosts/headless.h"
#include "app/origin.h"
#include "app/timings.h"
#include "core/error.h"
#include "core/heat_map.h"
#include "core/text.h"
#include "graph/shader_log.h"
#include "reference/reference_image.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

LayeredImage reference_for(const PointTask& task, const Shot& shot, const ReferenceSettings& settings,
                           const std::string& part, const std::function<void(const std::string&)>& say) {
    ReferenceGoal goal;
    goal.part = part;
    goal.samples = task.reference_samples;
    goal.noise = task.reference_samples > 0 ? 0 : task.reference_noise;
    double told = 0;
    auto tell = [&](const ReferenceProgress& progress) {
        if (progress.share >= told + 0.25) {
            told = progress.share;
            say(fmt::format("reference of {}, {}: {:.0f} %", task.session.shot,
                            settings.bounces < 0 ? "all bounces" : fmt::format("{} bounces", settings.bounces),
                            100 * progress.share));
        }
        return true;
    };
    const int frame = task.warm_up + task.frames - 1;
    if (task.device_reference) return device_reference(task.session, shot, settings, frame, goal, tell);
    return reference_image(shot, settings, frame, goal, tell).image;
}

} // namespace

void compare_with_reference(Session& session, ChartPoint& point, const std::function<void(const std::string&)>& say) {
    const PointTask& task = point.task;
    const Graph& graph = session.graph();
    const bool occlusion = only_occlusion(point.parts);
    LayeredImage picture = read_parts(session);

    // The references are of the same shot at the same size.
    Shot shot = load_shot(task.session.shot);
    shot.width = session.size().x;
    shot.height = session.size().y;
    ReferenceSettings settings = transport_settings(graph.model());
    if (task.bounces) settings.bounces = *task.bounces;
    if (task.diffuse_only) settings.diffuse_only = *task.diffuse_only;
    if (occlusion) settings.bounces = 0; // it has none
    // The goal of noise is the picture's as a whole; of a thorough task what is compared, which may be a small share of
    // it, and so far noisier.
    const bool of_part = occlusion || (task.thorough && point.parts.size() == 1);
    LayeredImage same = reference_for(task, shot, settings, of_part ? point.parts.front() : "out.radiance", say);
    ComparisonOptions options;
    options.parts = {join(point.parts, "+")};
    options.absent_is_black = true;
    const LayerComparison comparison = compare_layers(picture, same, options);
    point.kept_share = comparison.mask.share();
    point.same_transport = comparison.parts.front().figures;
    if (occlusion) {
        point.full = point.same_transport; // more light does not change what is open
    } else {
        LayeredImage full = reference_for(task, shot, ReferenceSettings(), "out.radiance", say);
        options.parts = {"out.radiance"};
        point.full = compare_layers(picture, full, options).parts.front().figures;
    }

    const Image truth = part_of(same, join(point.parts, "+"), "the reference");
    Image own = part_or_black(picture, join(point.parts, "+"), truth);
    const float exposure = comparison.parts.front().exposure;
    const auto picture_of = [&](const Image& image) {
        return page_picture(image, !occlusion, exposure, k_point_picture_width);
    };
    point.thumbnail_png = picture_of(own);
    point.error_png = page_error_map(relative_error_map(own, truth), 0.5f, comparison.mask, k_point_picture_width);
    if (!point.figures) return;
    point.reference_png = picture_of(truth);
    if (const auto direct = same.layers.find("out.direct"); !occlusion && direct != same.layers.end())
        add_shadow_errors(*point.figures, part_or_black(picture, "out.direct", direct->second), direct->second,
                          comparison.mask);
}

ChartPoint measure_point(const PointTask& task, const PointContent& content,
                         const std::function<void(const std::string&)>& say) {
    ChartPoint point;
    point.task = task;
    point.content = content;
    point.key = point_key(task, content);

    set_shader_errors_logged(false);
    Session session(task.session);
    throw_if_broken(session, "nothing was measured");
    for (int frame = 0; frame < task.warm_up + task.frames; ++frame) {
        if (frame > 0) session.advance();
        if (frame == task.warm_up) session.graph().forget_timings();
        session.render(true);
        if (frame == 0 && task.thorough) {
            session.graph().finish_timings();
            point.figures.emplace().first_ms = session.graph().frame_ms();
        }
    }
    session.graph().finish_timings();
    throw_if_broken(session, "nothing was measured");
    const Graph& graph = session.graph();
    const Transport& transport = graph.model().file().transport;
    for (const PlanPass& pass : graph.plan().passes) {
        PassTiming t = graph.timing(pass.id);
        point.passes.push_back({pass.id, t.median, t.low, t.high, bytes_of_pass(graph.plan(), pass.id)});
    }
    for (const PlanSkip& d : graph.plan().skipped)
        point.skipped.emplace_back(d.id, d.reason);
    point.total_ms = graph.frame_ms();
    point.bytes = graph.plan().total_bytes();
    point.transport_bounces = task.bounces.value_or(transport.bounces);
    point.parts = task.parts.empty() ? transport.parts : task.parts;
    compare_with_reference(session, point, say);
    if (point.figures) add_steady_figures(*point.figures, session, point.parts.front());
    const Origin origin = origin_here();
    point.renderer = origin.renderer;
    point.driver = origin.driver;
    point.machine = origin.machine;
    point.measured = origin.date;
    return point;
}

} // namespace bounce
