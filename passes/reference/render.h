#pragma once
// A progressive reference image. Every pixel has its own numbers and its own order of sums, so the bytes depend neither
// on the number of threads nor on how the work was cut into steps, interrupted and resumed.

#include "core/image.h"
#include "core/metrics.h"
#include "reference/settings.h"
#include "scene/shot.h"

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bounce {

struct TraceScene;
struct TracedRay;
class Integrator;

/// The noise of a part, from two independent half-images A and B: √ mean ((A − B)/2)² is the RMS standard error of
/// their mean.
struct PartNoise {
    double mean = 0;
    double rms = 0;           ///< over all pixels and channels
    double rms_off_edges = 0; ///< over the pixels that the edge mask keeps
    double mean_off_edges = 0;
    /// rms ÷ mean; 0 for a part that is all black.
    double relative() const { return mean > 0 ? rms / mean : 0; }
    double relative_off_edges() const { return mean_off_edges > 0 ? rms_off_edges / mean_off_edges : 0; }
};

class ReferenceRender {
  public:
    /// Builds the ray tracing scene of the shot's frame. Throws Error on bad settings or a size without pixels.
    ReferenceRender(const Shot& shot, const ReferenceSettings& settings, int frame = 0);
    ~ReferenceRender();

    /// Brings every pixel to `samples` samples. Returns false when cancelled before that; all samples taken are kept.
    bool render_to(int samples);
    /// Adds `count` samples to each pixel.
    bool step(int count) { return render_to(samples() + count); }
    /// From any thread: makes the running (or next) render_to return soon.
    void cancel() { cancelled_ = true; }
    /// From any thread: the share of the running render_to that is done, 0 … 1.
    double progress() const;

    int width() const { return width_; }
    int height() const { return height_; }
    int samples() const;                    ///< the least of any pixel
    int max_samples() const;                ///< the most of any pixel: more than samples() after a cancelled step
    uint64_t rays() const { return rays_; } ///< traced by this object so far
    const ReferenceSettings& settings() const { return settings_; }

    // The following must not run at the same time as render_to.

    /// Every part (k_reference_parts), out.radiance, and for masks gbuffer.normal, gbuffer.position, gbuffer.albedo,
    /// gbuffer.material (index, −1 = background), gbuffer.roughness and gbuffer.metallic at pixel centres. Positions
    /// are loaded ones (Scene::space). Metadata: JSON with shot, settings, samples and the noise of each part.
    LayeredImage image() const;
    /// One part (or out.radiance) as image() has it. Throws Error for an unknown name.
    Image part(const std::string& name) const;
    /// The mean of the even (0) or odd (1) samples only: two independent images.
    Image half(const std::string& name, int which) const;
    PartNoise noise(const std::string& name) const;
    /// Pixels away from depth and normal edges.
    const Mask& edge_mask() const;

    /// Everything rendered so far. `load_state` throws Error when the file is damaged or of another shot, size or
    /// setting.
    void save_state(const std::filesystem::path& path) const;
    void load_state(const std::filesystem::path& path);
    /// Names the shot's content, the settings that matter and the tracer's version: 32 hexadecimal digits.
    const std::string& key() const { return key_; }

    /// (samples, relative noise by part) at the sample counts of `checkpoints` that were passed; kept in the state.
    struct Checkpoint {
        int samples = 0;
        std::map<std::string, double> relative_noise;
    };
    const std::vector<Checkpoint>& history() const { return history_; }
    void add_checkpoint();

    /// What a state file says of itself, without its pixels.
    struct StateHeader {
        std::string key;
        int samples = 0, max_samples = 0;
        std::vector<Checkpoint> history;
    };

    /// All rays of the samples `from` … `to` − 1 of every pixel, in the order in which one thread traces them. For
    /// measurements.
    std::vector<TracedRay> rays_of_samples(int from, int to) const;
    const TraceScene& scene() const { return *scene_; }

  private:
    struct Tile {
        int x0, y0, x1, y1;
        int samples = 0;
    };
    void render_tile(Tile& tile, int samples);
    template <class Take>
    void trace_tile(const Tile& tile, int from, int to, Integrator& integrator, Take&& take) const;
    void make_centres() const;
    Image average(const std::string& name, int halves) const;
    uint32_t pixel_seed(int x, int y, int half) const;
    std::string metadata() const;

    ReferenceSettings settings_;
    std::string shot_name_, key_;
    LoadedSpace space_;
    int width_, height_;
    glm::vec3 camera_position_;
    std::unique_ptr<TraceScene> scene_;
    std::vector<Tile> tiles_;
    std::vector<float> sums_[2]; ///< by half: k_reference_channels floats a pixel
    std::vector<Checkpoint> history_;
    std::atomic<bool> cancelled_{false};
    std::atomic<uint64_t> rays_{0}, done_{0};
    std::atomic<uint64_t> planned_{0};

    struct Centres;
    mutable std::unique_ptr<Centres> centres_;
};

/// The header of a state file; nothing when it is missing or damaged.
std::optional<ReferenceRender::StateHeader> read_state_header(const std::filesystem::path& path);

} // namespace bounce
