#include "app/experiments/device_reference.h"

#include "app/broken_shaders.h"
#include "app/capture.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/metrics.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

namespace {

constexpr int k_step = 4; ///< samples of each half that a frame takes

/// Half of the samples: a session of its own, whose pictures are independent of the other's.
class Half {
  public:
    Half(const SessionOptions& shown, const ReferenceSettings& settings, int frame, int which)
        : session_(options(shown, settings, which)) {
        throw_if_broken(session_, "no reference was rendered");
        session_.set_frame(frame);
    }
    void render() { session_.render(true); }
    LayeredImage parts() { return read_parts(session_); }

  private:
    static SessionOptions options(const SessionOptions& shown, const ReferenceSettings& settings, int which) {
        SessionOptions own;
        own.shot = shown.shot;
        own.size = shown.size;
        own.material_model = shown.material_model;
        own.graph = "path_traced";
        own.rebuild = Rebuild::every_frame; // a frame that is rendered again adds its samples
        own.sets = {{"path.bounces", std::to_string(settings.bounces)},
                    {"path.microfacets", settings.diffuse_only ? "false" : "true"},
                    {"path.glossy_secondary", settings.diffuse_secondary ? "false" : "true"},
                    {"path.roulette_depth", std::to_string(settings.roulette_depth)},
                    {"path.seed", std::to_string(2 * settings.seed + unsigned(which))},
                    {"path.samples", std::to_string(k_step)}};
        return own;
    }
    Session session_;
};

Image mean_of(const Image& a, const Image& b) {
    Image mean = a;
    for (size_t i = 0; i < mean.pixels.size(); ++i)
        mean.pixels[i] = 0.5f * (a.pixels[i] + b.pixels[i]);
    return mean;
}

double relative(double rms, double mean) {
    return mean > 0 ? rms / mean : 0;
}

} // namespace

LayeredImage device_reference(const SessionOptions& shown, const Shot& shot, const ReferenceSettings& settings,
                              int frame, const ReferenceGoal& goal,
                              const std::function<bool(const ReferenceProgress&)>& on_progress) {
    // Surfaces, and all that files say of a reference, are the CPU's; two samples are next to nothing.
    ReferenceGoal least;
    least.samples = 2;
    LayeredImage image = reference_image(
                             shot, settings, frame, least, [](const ReferenceProgress&) { return true; }, false)
                             .image;
    std::erase_if(image.layers, [](const auto& layer) {
        return layer.first.starts_with("irradiance.") || layer.first.starts_with("out.ambient_occlusion");
    });
    if (!image.layers.contains(goal.part))
        throw Error(fmt::format("invalid reference on the device for '{}': expected a part that light makes up, as "
                                "out.radiance",
                                goal.part));
    const glm::vec3 camera = evaluate_shot(shot, frame).camera.position;
    const Mask interior = edge_mask(image.layers.at("gbuffer.normal"), image.layers.at("gbuffer.position"), camera);
    const Mask all(shot.width, shot.height);

    Half first(shown, settings, frame, 0), second(shown, settings, frame, 1);
    const int most = goal.samples > 0 ? goal.samples : goal.max_samples;
    nlohmann::ordered_json json = parse_json<nlohmann::ordered_json>(image.metadata, "the reference");
    json["renderer"] = "path_traced";
    json["noise"] = nlohmann::ordered_json::object();
    ReferenceProgress progress;
    int next_look = goal.samples > 0 ? most : reference_checkpoint(0);
    for (bool going = true; going;) {
        first.render();
        second.render();
        progress.samples += 2 * k_step;
        going = progress.samples < most;
        if (going && progress.samples < next_look) continue;
        next_look = reference_checkpoint(progress.samples);
        const LayeredImage a = first.parts(), b = second.parts();
        for (auto& [name, layer] : image.layers) {
            if (!name.starts_with("out.")) continue;
            const Image &half_a = a.layers.at(name), &half_b = b.layers.at(name);
            layer = mean_of(half_a, half_b);
            const double mean = image_mean(layer, all), rms = half_image_noise(half_a, half_b, all);
            const double inside = interior.count() > 0 ? image_mean(layer, interior) : 0;
            const double noise = interior.count() > 0 ? half_image_noise(half_a, half_b, interior) : 0;
            json["noise"][name] = {{"mean", mean},
                                   {"rms", rms},
                                   {"relative", relative(rms, mean)},
                                   {"mean_off_edges", inside},
                                   {"rms_off_edges", noise},
                                   {"relative_off_edges", relative(noise, inside)}};
            if (name == goal.part) progress.noise = relative(noise, inside);
        }
        going = going && !(goal.samples == 0 && progress.noise <= goal.noise);
        progress.share = going ? double(progress.samples) / most : 1;
        if (!on_progress(progress)) break;
    }
    json["samples"] = progress.samples;
    image.metadata = json_dump(json, -1);
    return image;
}

} // namespace bounce
