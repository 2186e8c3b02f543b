#include "reference/render.h"

#include "core/error.h"
#include "core/text.h"
#include "reference/content_key.h"
#include "reference/integrator.h"
#include "scene/loaded_space.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace bounce {

namespace {
constexpr int k_tile = 16;
/// Samples a pixel takes between two looks at `cancelled_`.
constexpr int k_pass = Integrator::k_max_together;
} // namespace

struct ReferenceRender::Centres {
    Image normal, position, albedo, material, roughness, metallic;
    Mask mask;
};

/// What the shot has loaded is checked already; a window, or a program, may have set anything since.
static void check_state(const ShotState& state) {
    const Camera& camera = state.camera;
    check_place(camera.position, "the camera");
    check_place(camera.target, "the camera's target");
    check_place(camera.up, "the tip of the camera's up vector");
    if (!(camera.vfov > 0 && camera.vfov < 3.1415927f))
        throw Error(fmt::format("invalid field of view of the camera {:g}: expected an angle above 0 and below π",
                                camera.vfov));
    for (const Light& light : state.scene.lights) {
        const std::string what = fmt::format("light '{}'", light.name.substr(0, 60));
        if (light.type != LightType::directional) check_place(light.position, what);
        check_place(light.direction, "the direction of " + what);
        if (!std::isfinite(light.intensity.r + light.intensity.g + light.intensity.b))
            throw Error(fmt::format("invalid intensity of {}: expected finite numbers", what));
    }
}

ReferenceRender::ReferenceRender(const Shot& shot, const ReferenceSettings& settings, int frame)
    : settings_(settings), shot_name_(shot.name), space_(shot.scene.space), width_(shot.width), height_(shot.height) {
    if (width_ <= 0 || height_ <= 0 || int64_t(width_) * height_ > (int64_t(1) << 27)) {
        throw Error(
            fmt::format("a reference of {}x{} pixels cannot be made; both must be at least 1, and their product "
                        "at most 134,217,728",
                        width_, height_));
    }
    if (settings.bounces < k_unlimited_bounces) {
        throw Error(fmt::format("bounces must be 0 or more (or -1 for all of them), not {}", settings.bounces));
    }
    if (!(settings.occlusion_distance > 0)) throw Error("the occlusion distance must be above 0");
    if (settings.roulette_depth < 1) throw Error("the roulette depth must be at least 1");
    if (settings.threads < 0) throw Error("the number of threads must be 0 (all) or more");
    const ShotState state = evaluate_shot(shot, frame);
    check_state(state);
    camera_position_ = state.camera.position;
    key_ = content_key(shot, state, settings_);
    scene_ = std::make_unique<TraceScene>(shot, state, settings_);
    for (int y = 0; y < height_; y += k_tile) {
        for (int x = 0; x < width_; x += k_tile) {
            tiles_.push_back({x, y, std::min(width_, x + k_tile), std::min(height_, y + k_tile)});
        }
    }
    for (auto& sums : sums_)
        sums.assign(size_t(width_) * size_t(height_) * k_reference_channels, 0.0f);
}

ReferenceRender::~ReferenceRender() = default;

uint32_t ReferenceRender::pixel_seed(int x, int y, int half) const {
    return hash_combine(hash_combine(hash_combine(settings_.seed, uint32_t(half)), uint32_t(x)), uint32_t(y));
}

/// Samples `from` … `to` − 1 (at most k_pass of them) of the tile's pixels: take(first channel of the pixel, i,
/// sample). Sample i belongs to half i mod 2, each of which is a sequence of its own.
template <class Take>
void ReferenceRender::trace_tile(const Tile& tile, int from, int to, Integrator& integrator, Take&& take) const {
    std::vector<PixelSampler> samplers;
    PixelSample samples[k_pass];
    for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) {
            const uint32_t seeds[2] = {pixel_seed(x, y, 0), pixel_seed(x, y, 1)};
            const size_t first = (size_t(y) * size_t(width_) + size_t(x)) * k_reference_channels;
            samplers.clear();
            for (int i = from; i < to; ++i)
                samplers.emplace_back(seeds[i & 1], uint32_t(i >> 1), settings_.stratified);
            integrator.sample(x, y, samplers, {samples, samplers.size()});
            for (int i = from; i < to; ++i)
                take(first, i, samples[i - from]);
        }
    }
}

void ReferenceRender::render_tile(Tile& tile, int samples) {
    Integrator integrator(*scene_);
    while (tile.samples < samples && !cancelled_) {
        const int end = std::min(samples, tile.samples + k_pass);
        trace_tile(tile, tile.samples, end, integrator, [this](size_t first, int i, const PixelSample& sample) {
            float* sums = &sums_[i & 1][first];
            for (int c = 0; c < k_reference_channels; ++c)
                sums[c] += sample[size_t(c)];
        });
        done_ += uint64_t(end - tile.samples) * uint64_t(tile.x1 - tile.x0) * uint64_t(tile.y1 - tile.y0);
        tile.samples = end;
    }
    rays_ += integrator.rays();
}

bool ReferenceRender::render_to(int samples) {
    uint64_t planned = 0;
    for (const Tile& tile : tiles_) {
        planned +=
            uint64_t(std::max(0, samples - tile.samples)) * uint64_t(tile.x1 - tile.x0) * uint64_t(tile.y1 - tile.y0);
    }
    done_ = 0;
    planned_ = planned;
    const int most = tbb::this_task_arena::max_concurrency(); // more than there are would only draw a warning
    tbb::task_arena arena(settings_.threads > 0 ? std::min(settings_.threads, most) : most);
    arena.execute([&] {
        tbb::parallel_for(
            tbb::blocked_range<size_t>(0, tiles_.size(), 1),
            [&](const tbb::blocked_range<size_t>& range) {
                for (size_t i = range.begin(); i < range.end() && !cancelled_; ++i)
                    render_tile(tiles_[i], samples);
            },
            tbb::simple_partitioner());
    });
    return !cancelled_.exchange(false) || this->samples() >= samples;
}

double ReferenceRender::progress() const {
    const uint64_t planned = planned_;
    return planned ? std::min(1.0, double(done_) / double(planned)) : 1.0;
}

int ReferenceRender::samples() const {
    return std::min_element(tiles_.begin(), tiles_.end(), [](auto& a, auto& b) { return a.samples < b.samples; })
        ->samples;
}

int ReferenceRender::max_samples() const {
    return std::max_element(tiles_.begin(), tiles_.end(), [](auto& a, auto& b) { return a.samples < b.samples; })
        ->samples;
}

/// `halves` is a set of bits: 1 = the even samples, 2 = the odd ones.
Image ReferenceRender::average(const std::string& name, int halves) const {
    std::vector<int> offsets;
    int channels = 3;
    if (name == "out.radiance") {
        for (int i = 0; i < k_radiance_parts; ++i)
            offsets.push_back(k_reference_parts[size_t(i)].offset);
    } else {
        std::vector<std::string> names{"out.radiance"};
        for (const ReferencePart& part : k_reference_parts) {
            names.emplace_back(part.name);
            if (part.name != name) continue;
            offsets.push_back(part.offset);
            channels = part.channels;
        }
        if (offsets.empty()) throw Error("the reference has no part '" + name + "'" + did_you_mean(name, names));
    }
    Image image(width_, height_, channels);
    for (const Tile& tile : tiles_) {
        const int even = (tile.samples + 1) / 2, odd = tile.samples / 2;
        const int count = (halves & 1 ? even : 0) + (halves & 2 ? odd : 0);
        if (count == 0) continue;
        for (int y = tile.y0; y < tile.y1; ++y) {
            for (int x = tile.x0; x < tile.x1; ++x) {
                const size_t first = (size_t(y) * size_t(width_) + size_t(x)) * k_reference_channels;
                for (int c = 0; c < channels; ++c) {
                    double sum = 0;
                    for (int offset : offsets) {
                        for (int h = 0; h < 2; ++h) {
                            if (halves >> h & 1) sum += sums_[h][first + size_t(offset + c)];
                        }
                    }
                    image.at(x, y)[c] = float(sum / count);
                }
            }
        }
    }
    return image;
}

Image ReferenceRender::part(const std::string& name) const {
    return average(name, 3);
}

Image ReferenceRender::half(const std::string& name, int which) const {
    return average(name, which == 0 ? 1 : 2);
}

PartNoise ReferenceRender::noise(const std::string& name) const {
    const Image a = half(name, 0), b = half(name, 1), both = part(name);
    const Mask all(width_, height_);
    PartNoise noise;
    noise.mean = image_mean(both, all);
    noise.rms = half_image_noise(a, b, all);
    const Mask& interior = edge_mask();
    if (interior.count() > 0) {
        noise.mean_off_edges = image_mean(both, interior);
        noise.rms_off_edges = half_image_noise(a, b, interior);
    }
    return noise;
}

void ReferenceRender::make_centres() const {
    if (centres_) return;
    auto centres = std::make_unique<Centres>();
    centres->normal = centres->position = centres->albedo = Image(width_, height_, 3);
    centres->material = centres->roughness = centres->metallic = Image(width_, height_, 1);
    Integrator integrator(*scene_);
    for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x) {
            const PixelSurface surface = integrator.centre(x, y);
            for (int c = 0; c < 3; ++c) {
                centres->normal.at(x, y)[c] = surface.normal[c];
                centres->position.at(x, y)[c] = surface.position[c];
                centres->albedo.at(x, y)[c] = surface.albedo[c];
            }
            *centres->material.at(x, y) = surface.material;
            *centres->roughness.at(x, y) = surface.roughness;
            *centres->metallic.at(x, y) = surface.metallic;
        }
    }
    centres->mask = bounce::edge_mask(centres->normal, centres->position, camera_position_);
    centres_ = std::move(centres);
}

const Mask& ReferenceRender::edge_mask() const {
    make_centres();
    return centres_->mask;
}

LayeredImage ReferenceRender::image() const {
    make_centres();
    LayeredImage image;
    for (const ReferencePart& p : k_reference_parts)
        image.layers[std::string(p.name)] = part(std::string(p.name));
    image.layers["out.radiance"] = part("out.radiance");
    image.layers["gbuffer.normal"] = centres_->normal;
    image.layers["gbuffer.position"] = centres_->position;
    image.layers["gbuffer.albedo"] = centres_->albedo;
    image.layers["gbuffer.material"] = centres_->material;
    image.layers["gbuffer.roughness"] = centres_->roughness;
    image.layers["gbuffer.metallic"] = centres_->metallic;
    image.metadata = metadata();
    return image;
}

std::string ReferenceRender::metadata() const {
    nlohmann::ordered_json json;
    json["program"] = "bounce";
    json["kind"] = "reference";
    json["tracer_version"] = k_tracer_version;
    json["key"] = key_;
    json["shot"] = shot_name_;
    json["width"] = width_;
    json["height"] = height_;
    json["samples"] = samples();
    json["bounces"] = settings_.bounces;
    json["diffuse_only"] = scene_->diffuse_only;
    json["diffuse_secondary"] = settings_.diffuse_secondary;
    json["material_model"] = k_material_models[size_t(scene_->material_model)];
    json["occlusion_distance"] = scene_->occlusion_distance;
    json["occlusion_falloff"] = k_occlusion_falloffs[size_t(settings_.occlusion_falloff)];
    json["roulette_depth"] = settings_.roulette_depth;
    json["stratified"] = settings_.stratified;
    json["seed"] = settings_.seed;
    // gbuffer.position and this are loaded coordinates: file = origin + unit · loaded.
    json["camera_position"] = {camera_position_.x, camera_position_.y, camera_position_.z};
    if (!(space_ == LoadedSpace{})) {
        json["origin"] = {space_.origin.x, space_.origin.y, space_.origin.z};
        json["unit"] = space_.unit;
    }
    auto add = [&](const std::string& name) {
        const PartNoise n = noise(name);
        json["noise"][name] = {{"mean", n.mean},
                               {"rms", n.rms},
                               {"relative", n.relative()},
                               {"mean_off_edges", n.mean_off_edges},
                               {"rms_off_edges", n.rms_off_edges},
                               {"relative_off_edges", n.relative_off_edges()}};
    };
    add("out.radiance");
    for (const ReferencePart& p : k_reference_parts)
        add(std::string(p.name));
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void ReferenceRender::add_checkpoint() {
    const int now = samples();
    if (!history_.empty() && history_.back().samples >= now) return;
    Checkpoint checkpoint;
    checkpoint.samples = now;
    checkpoint.relative_noise["out.radiance"] = noise("out.radiance").relative_off_edges();
    for (const ReferencePart& p : k_reference_parts) {
        checkpoint.relative_noise[std::string(p.name)] = noise(std::string(p.name)).relative_off_edges();
    }
    history_.push_back(std::move(checkpoint));
}

std::vector<TracedRay> ReferenceRender::rays_of_samples(int from, int to) const {
    std::vector<TracedRay> rays;
    Integrator integrator(*scene_);
    integrator.record_rays(&rays);
    for (const Tile& tile : tiles_) {
        for (int i = from; i < to; i += k_pass) {
            trace_tile(tile, i, std::min(to, i + k_pass), integrator, [](size_t, int, const PixelSample&) {});
        }
    }
    return rays;
}

} // namespace bounce
