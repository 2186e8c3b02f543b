#pragma once
// The picture beside the truth: a reference rendered in the background, what the viewport shows of the pair, and how
// far apart they are.

#include "app/session.h"
#include "core/image.h"
#include "core/metrics.h"
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
    double ms = 0;
    double relative_rmse = 0;
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
    double reference_noise() const { return reference_noise_; }

    /// Takes over a finished reference and, after a new frame, measures. Returns true when the picture to show changed.
    bool update(const Session& session);
    const ErrorFigures& figures() const { return figures_; }
    bool measured() const { return measured_frames_ != ~0ull; }
    /// FLIP of the present pair; takes its time, so it is only computed when asked for.
    double measure_flip();

    /// The rgba8 picture of the chosen view at the session's size; null when there is none to show.
    const GpuTexture* picture(const Session& session, double seconds);
    void release_gpu();

    std::vector<ComparePoint> points; ///< kept by the person, or loaded from a chart
    ComparePoint live(const Session& session) const;

  private:
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
    std::vector<std::string> parts_;
    LayeredImage reference_;
    Image truth_, own_, display_; ///< summed parts of both, and the graph's own out.display
    Mask mask_;
    ErrorFigures figures_;
    int samples_ = 0;
    double reference_noise_ = 0;
    uint64_t measured_frames_ = ~0ull;
    GpuTexture picture_;
    std::string composed_; ///< what picture_ was made from
};

} // namespace bounce
