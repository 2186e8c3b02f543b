// Renders one point of a chart and compares it with the reference of its own transport and with the full one.
#include "app/capture.h"
#include "app/experiments/chart_point.h"
#include "app/experiments/parts.h"
#include "app/experiments/transport.h"
#include "app/hosts/headless.h"
#include "app/timings.h"
#include "core/base64.h"
#include "core/comparison.h"
#include "core/error.h"
#include "core/flip.h"
#include "core/heat_map.h"
#include "core/metrics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

/// A reference with what a comparison needs beside its pixels.
struct Truth {
    Image image;
    Mask mask;
    Image8 display; ///< tone-mapped, at the exposure of the pair
    float exposure = 0;
    double noise = 0;
};

LayeredImage reference_for(const PointTask& task, const Shot& shot, const ReferenceSettings& settings,
                           const std::string& part, const std::function<void(const std::string&)>& say) {
    ReferenceGoal goal;
    goal.part = part;
    goal.samples = task.reference_samples;
    goal.noise = task.reference_samples > 0 ? 0 : task.reference_noise;
    double told = 0;
    ReferenceResult result =
        reference_image(shot, settings, task.warm_up + task.frames - 1, goal, [&](const ReferenceProgress& progress) {
            if (progress.share >= told + 0.25) {
                told = progress.share;
                say(fmt::format("reference of {}, {}: {:.0f} %", task.shot,
                                settings.bounces < 0 ? "all bounces" : fmt::format("{} bounces", settings.bounces),
                                100 * progress.share));
            }
            return true;
        });
    return std::move(result.image);
}

/// What an eye would see of it: light through the tone curve, occlusion as it is.
Image shown(const Image& linear, bool light, float exposure) {
    if (light) return display_values(linear, exposure);
    Image out(linear.width, linear.height, 3);
    for (size_t i = 0; i < out.pixels.size(); ++i)
        out.pixels[i] = std::clamp(linear.pixels[i / 3 * size_t(linear.channels)], 0.0f, 1.0f);
    return out;
}

Image8 small_picture(const Image& display, int width) {
    int w = std::min(width, display.width), h = std::max(1, display.height * w / display.width);
    Image8 out{w, h, std::vector<uint8_t>(size_t(w) * h * 4, 255)};
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) { // the mean of the pixels that fall into this one
            int x0 = x * display.width / w, x1 = std::max(x0 + 1, (x + 1) * display.width / w);
            int y0 = y * display.height / h, y1 = std::max(y0 + 1, (y + 1) * display.height / h);
            float sum[3] = {};
            for (int sy = y0; sy < y1; ++sy) {
                for (int sx = x0; sx < x1; ++sx) {
                    for (int c = 0; c < 3; ++c)
                        sum[c] += display.at(sx, sy)[c];
                }
            }
            for (int c = 0; c < 3; ++c) {
                out.rgba[(size_t(y) * w + x) * 4 + size_t(c)] =
                    uint8_t(std::lround(255 * srgb_encode(sum[c] / float((x1 - x0) * (y1 - y0)))));
            }
        }
    }
    return out;
}

PointError compare(const Image& picture, const LayeredImage& reference, const std::vector<std::string>& parts,
                   const Mask& mask) {
    Image truth = sum_of_parts(reference, parts);
    PointError out;
    ErrorFigures figures = error_figures(picture, truth, mask);
    out.mean = figures.mean;
    out.reference_mean = figures.reference_mean;
    out.bias = figures.bias;
    out.rmse = figures.rmse;
    out.relative_rmse = figures.relative_rmse;
    out.relative_mse = figures.relative_mse;
    out.p99 = figures.relative_error_p99;
    const bool light = !only_occlusion(parts);
    float exposure = light ? automatic_exposure(truth, mask) : 0;
    Image a = shown(picture, light, exposure), b = shown(truth, light, exposure);
    out.flip = flip_mean(flip(a, b), mask);
    out.ssim = ssim(a, b, mask);
    out.reference_noise = noise_of_parts(reference, parts);
    const double noise = out.reference_noise * figures.reference_mean;
    out.rmse_without_noise = std::sqrt(std::max(0.0, figures.rmse * figures.rmse - noise * noise));
    return out;
}

} // namespace

void compare_with_reference(Session& session, ChartPoint& point, const std::function<void(const std::string&)>& say) {
    const PointTask& task = point.task;
    const Graph& graph = session.graph();
    const bool occlusion = only_occlusion(point.parts);
    LayeredImage picture = read_parts(session);

    // The references are of the same shot at the same size.
    Shot shot = load_shot(task.shot);
    shot.width = task.size.x;
    shot.height = task.size.y;
    ReferenceSettings settings = transport_settings(graph.model());
    if (occlusion) settings.bounces = 0; // it has none
    LayeredImage same = reference_for(task, shot, settings, occlusion ? point.parts.front() : "out.radiance", say);
    const glm::vec3 eye = evaluate_shot(shot, task.warm_up + task.frames - 1).camera.position;
    Mask mask = edge_mask(same.layers.at("gbuffer.normal"), same.layers.at("gbuffer.position"), eye);
    point.kept_share = mask.share();
    Image own = sum_of_parts(picture, point.parts);
    point.same_transport = compare(own, same, point.parts, mask);
    if (occlusion) {
        point.full = point.same_transport; // more light does not change what is open
    } else {
        ReferenceSettings all;
        LayeredImage full = reference_for(task, shot, all, "out.radiance", say);
        point.full = compare(sum_of_parts(picture, {"out.radiance"}), full, {"out.radiance"}, mask);
    }

    Image truth = sum_of_parts(same, point.parts);
    const float exposure = occlusion ? 0 : automatic_exposure(truth, mask);
    point.thumbnail_png = base64(encode_png(small_picture(shown(own, !occlusion, exposure), 240)));
    point.error_png = base64(encode_png(heat_map(relative_error_map(own, truth), 0, 0.5f, mask)));
}

ChartPoint measure_point(const PointTask& task, const std::function<void(const std::string&)>& say) {
    ChartPoint point;
    point.task = task;
    point.key = task.key();

    SessionOptions options;
    options.shot = task.shot;
    options.graph = task.graph;
    options.sets = task.values;
    options.size = task.size;
    Session session(options);
    for (int frame = 0; frame < task.warm_up + task.frames; ++frame) {
        if (frame > 0) session.advance();
        if (frame == task.warm_up) session.graph().forget_timings();
        session.render(true);
    }
    session.graph().finish_timings();
    for (const GraphProblem& problem : session.graph().problems())
        throw Error(problem.error.text());
    const Graph& graph = session.graph();
    const Transport& transport = graph.model().file().transport;
    for (const PlanPass& pass : graph.plan().passes) {
        PassTiming t = graph.timing(pass.id);
        point.passes.push_back({pass.id, t.median, t.low, t.high, bytes_of_pass(graph.plan(), pass.id)});
    }
    for (const PlanDecline& d : graph.plan().declined)
        point.declined.emplace_back(d.id, d.reason);
    point.total_ms = graph.frame_ms();
    point.bytes = graph.plan().total_bytes();
    point.transport_bounces = transport.bounces;
    point.parts = task.parts.empty() ? transport.parts : task.parts;
    compare_with_reference(session, point, say);
    point.renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    point.commit = program_commit();
    return point;
}

} // namespace bounce
