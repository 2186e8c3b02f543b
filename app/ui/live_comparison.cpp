#include "app/ui/live_comparison.h"

#include "app/capture.h"
#include "app/experiments/transport.h"
#include "app/ui/settings_key.h"
#include "core/error.h"
#include "core/heat_map.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

static bool models_everything(const LiveComparison& comparison, const Session& session) {
    return comparison.full_transport || session.graph().model().file().transport.bounces < 0;
}

/// What the reference depends on, as far as the window can change it.
std::string LiveComparison::key_of(const Session& session) const {
    const Transport& transport = session.graph().model().file().transport;
    const ReferenceSettings settings = transport_settings(session.graph().model());
    return fmt::format("{} {} {} {}x{} {} {} {} {} {} {}", session.options().shot, session.edits(),
                       camera_json(session.camera(), session.shot().scene.space), session.size().x, session.size().y,
                       session.frame(), models_everything(*this, session) ? -1 : transport.bounces,
                       !full_transport && transport.diffuse_only, !full_transport && transport.diffuse_secondary,
                       settings.occlusion_distance, int(settings.occlusion_falloff));
}

bool LiveComparison::stale(const Session& session) const {
    return key_of(session) != reference_key_;
}

void LiveComparison::start(const Session& session) {
    stop();
    auto shot = std::make_shared<Shot>(session.shot());
    shot->camera = session.camera();
    shot->camera_path = {};
    shot->width = session.size().x;
    shot->height = session.size().y;
    const Transport& transport = session.graph().model().file().transport;
    ReferenceSettings settings = transport_settings(session.graph().model());
    settings.bounces = models_everything(*this, session) ? k_unlimited_bounces : transport.bounces;
    settings.diffuse_only = !full_transport && transport.diffuse_only;
    settings.diffuse_secondary = !full_transport && transport.diffuse_secondary;
    started_part_ = full_transport ? "out.radiance" : join(transport.parts, "+");
    started_key_ = key_of(session);
    int frame = session.frame();
    double target = noise;
    {
        std::lock_guard lock(mutex_);
        problem_.clear();
        progress_ = {};
        has_fresh_ = false;
    }
    running_ = true;
    thread_ = std::jthread([this, shot, settings, frame, target](std::stop_token stop_token) {
        try {
            // Better and better: each goal goes on from the samples of the one before.
            for (int samples = 8; samples <= 1 << 16 && !stop_token.stop_requested(); samples *= 4) {
                ReferenceGoal goal;
                goal.samples = samples;
                ReferenceResult result =
                    reference_image(*shot, settings, frame, goal, [&](const ReferenceProgress& now) {
                        std::lock_guard lock(mutex_);
                        progress_ = now;
                        return !stop_token.stop_requested();
                    });
                if (!result.complete) break;
                double reached = result.noise;
                std::lock_guard lock(mutex_);
                fresh_ = std::move(result);
                has_fresh_ = true;
                if (reached <= target) break;
            }
        } catch (const std::exception& error) {
            std::lock_guard lock(mutex_);
            problem_ = error.what();
        }
        running_ = false;
    });
}

void LiveComparison::stop() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
}

ReferenceProgress LiveComparison::progress() const {
    std::lock_guard lock(mutex_);
    return progress_;
}

std::string LiveComparison::problem() const {
    std::lock_guard lock(mutex_);
    return problem_;
}

bool LiveComparison::update(const Session& session) {
    bool changed = false;
    {
        std::lock_guard lock(mutex_);
        if (has_fresh_) {
            reference_ = std::move(fresh_.image);
            samples_ = fresh_.samples;
            part_ = started_part_;
            reference_key_ = started_key_;
            has_fresh_ = false;
            changed = true;
        }
    }
    if (!has_reference() || stale(session)) return changed;
    if (!changed && measured_frames_ == session.graph().frames()) return false;
    measured_frames_ = session.graph().frames();
    truth_ = part_of(reference_, part_, "the reference");
    parts_ = read_parts(session);
    own_ = part_or_black(parts_, part_, truth_);
    if (own_.pixels.size() != truth_.pixels.size()) return changed;
    measure(false);
    return true;
}

void LiveComparison::measure(bool shown) {
    ComparisonOptions options;
    options.parts = {part_};
    options.absent_is_black = true;
    options.shown = shown;
    try {
        const LayerComparison comparison = compare_layers(parts_, reference_, options);
        mask_ = comparison.mask;
        figures_ = comparison.parts.front().figures;
    } catch (const std::exception& error) { // a NaN in the picture …
        figures_ = {};
        if (mask_.width != truth_.width || mask_.height != truth_.height) mask_ = Mask(truth_.width, truth_.height);
        std::lock_guard lock(mutex_);
        problem_ = error.what();
    }
}

void LiveComparison::measure_shown() {
    if (!own_.empty() && !truth_.empty()) measure(true);
}

ComparePoint LiveComparison::live(const Session& session) const {
    std::string label = session.options().graph;
    for (const auto& [name, value] : session.changed_parameters(ParameterOrigin::command_line))
        label += " " + name + "=" + value;
    const Transport& transport = session.graph().model().file().transport;
    const std::string what =
        full_transport ? transport_text(-1, {"out.radiance"}) : transport_text(transport.bounces, transport.parts);
    return {label, what, whole_frame_ms(session.graph()), figures_};
}

void LiveComparison::release_gpu() {
    picture_ = {};
    composed_.clear();
}

/// Half a second each.
static bool is_second_half(double seconds) {
    return std::fmod(seconds, 1.0) >= 0.5;
}

const GpuTexture* LiveComparison::picture(const Session& session, double seconds) {
    if (view == CompareView::off) return nullptr;
    update(session); // the panel may be hidden
    if (!has_reference() || stale(session) || own_.empty()) return nullptr;
    bool second = view == CompareView::flicker && is_second_half(seconds);
    std::string wanted =
        fmt::format("{} {} {} {} {} {}", int(view), split, second, error_range, measured_frames_, samples_);
    if (wanted != composed_ || !picture_) {
        compose(session, second);
        composed_ = wanted;
    }
    return &picture_;
}

namespace {

/// How the graph shows light: exposure and curve of its pass `tonemap`, where it has one. Occlusion is shown as it is.
struct Tone {
    float exposure = 0; ///< stops
    bool aces_like = false;
    bool light = true;

    Tone(const Session& session, bool is_light) : light(is_light) {
        const PassNode* tonemap = is_light ? session.graph().model().find_node("tonemap") : nullptr;
        if (!tonemap) return;
        if (const Parameter* p = tonemap->parameters.find("exposure")) exposure = std::get<float>(p->value);
        if (const Parameter* p = tonemap->parameters.find("curve")) aces_like = std::get<int>(p->value) == 1;
    }
    uint8_t shown(float value) const {
        float x = value * std::exp2(exposure);
        if (aces_like) x = x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f);
        if (!std::isfinite(x)) x = 0;
        return uint8_t(std::lround(255 * srgb_encode(std::clamp(x, 0.0f, 1.0f))));
    }
    std::string text() const {
        if (!light) return "as it is";
        return fmt::format("exposure {:g}, {}", exposure, aces_like ? "curve aces_like" : "no curve");
    }
};

} // namespace

std::string LiveComparison::caption(const Session& session, double seconds) const {
    const std::string light = parts_text(bounce::split(part_, '+'));
    const std::string how = light + ", " + Tone(session, !only_occlusion()).text();
    switch (view) {
    case CompareView::split:
        return "graph | reference: " + how;
    case CompareView::flicker:
        return std::string(is_second_half(seconds) ? "reference" : "graph") + ": " + how;
    case CompareView::reference:
        return "reference: " + how;
    case CompareView::error:
        return fmt::format("relative error of {}, 0 to {:.0f} %", light, 100 * error_range);
    case CompareView::off:
        break;
    }
    return {};
}

/// Both sides are the same light, toned alike.
void LiveComparison::compose(const Session& session, bool second_half) {
    glm::ivec2 size = session.size();
    const Tone tone(session, !only_occlusion());
    Image8 image{size.x, size.y, std::vector<uint8_t>(size_t(size.x) * size.y * 4, 255)};
    if (view == CompareView::error) {
        image = heat_map(relative_error_map(own_, truth_), 0, std::max(error_range, 1e-3f), mask_);
    } else {
        int border = view == CompareView::split                     ? int(split * float(size.x))
                     : view == CompareView::flicker && !second_half ? size.x
                                                                    : 0;
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const Image& side = x < border ? own_ : truth_;
                for (int c = 0; c < 3; ++c)
                    image.rgba[(size_t(y) * size.x + x) * 4 + size_t(c)] =
                        tone.shown(side.at(x, y)[std::min(c, side.channels - 1)]);
            }
        }
    }
    TextureDesc desc{TextureKind::texture_2d, GL_RGBA8, {size.x, size.y, 1}, 1};
    if (!picture_ || picture_.desc() != desc) {
        picture_ = GpuTexture(desc, "comparison");
        // Magnified as the graph's own picture is.
        glTextureParameteri(picture_.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(picture_.id(), 0, 0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
}

} // namespace bounce
