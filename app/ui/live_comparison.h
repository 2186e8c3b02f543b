#pragma once
// The picture beside the truth: a reference rendered in the background, what the viewport shows of the pair, and how
// far apart they are.

#include "app/experiments/chart_point.h"
#include "core/comparison.h"
#include "reference/reference_image.h"

#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace bounce {

enum class CompareView { off, split, flicker, error, reference };

/// One measured state of the picture, for the chart.
struct ComparePoint {
    std::string label;
    std::string transport; ///< what is compared: points of one are a front
    double ms = 0;
    MetricValues figures;
};

class LiveComparison {
  public:
    ~LiveComparison() { stop(); }

    // What a person chooses.
    CompareView view = CompareView::off;
    float split = 0.5f;          ///< share of the width that shows the graph's picture
    bool full_transport = false; ///< compare with all light instead of what the graph models
    float noise = 0.02f;         ///< relative noise at which the reference is done
    float error_range = 0.5f;    ///< relative error that is drawn brightest

    /// Renders the reference of the session's present shot, camera, size and frame in the background, better and
    /// better.
    void start(const Session& session);
    void stop();
    bool running() const { return running_; }
    ReferenceProgress progress() const;
    std::string problem() const; ///< why the last run failed; "" = it did not

    bool has_reference() const { return !reference_.layers.empty(); }
    /// The session shows something else by now than the reference does.
    bool stale(const Session& session) const;
    int samples() const { return samples_; }

    /// Takes over a finished reference and, after a new frame, measures. Returns true when the picture to show changed.
    bool update(const Session& session);
    const MetricValues& figures() const { return figures_; }
    double kept_share() const { return mask_.share(); }
    bool measured() const { return measured_frames_ != ~0ull; }
    /// Adds the metrics of display values for the present pair; they take their time, so only when asked for.
    void measure_shown();

    /// What the view shows of which light, with which tone curve.
    std::string caption(const Session& session, double seconds) const;
    /// The rgba8 picture of the chosen view at the session's size; null when there is none to show.
    const GpuTexture* picture(const Session& session, double seconds);
    void release_gpu();

    std::vector<ComparePoint> points;     ///< kept by the person, or loaded from a chart
    std::string metric = k_default_error; ///< by which points are drawn
    ComparePoint live(const Session& session) const;
    /// Occlusion alone is compared, in AO units.
    bool only_occlusion() const { return !part_.empty() && !is_radiance(part_); }

  private:
    void measure(bool shown);
    std::string key_of(const Session& session) const;
    void compose(const Session& session, bool second_half);

    std::jthread thread_;
    mutable std::mutex mutex_; ///< guards the next four
    ReferenceProgress progress_;
    ReferenceResult fresh_;
    bool has_fresh_ = false;
    std::string problem_;
    std::atomic<bool> running_{false};

    std::string started_key_, reference_key_;
    std::string started_part_, part_; ///< what is compared: "out.a+out.b"
    LayeredImage reference_, parts_;
    Image truth_, own_; ///< summed parts of both
    Mask mask_;
    MetricValues figures_;
    int samples_ = 0;
    uint64_t measured_frames_ = ~0ull;
    GpuTexture picture_;
    std::string composed_; ///< what picture_ was made from
};

} // namespace bounce
