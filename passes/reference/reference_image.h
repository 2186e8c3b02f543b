#pragma once
// A finished reference: rendered to a number of samples or a noise level, found in the cache when it was made before,
// resumed where a run broke off.

#include "reference/render.h"

#include <functional>

namespace bounce {

struct ReferenceGoal {
    int samples = 0;  ///< a pixel; 0 = by noise
    double noise = 0; ///< relative noise (RMS standard error ÷ mean) of `part` off edges, checked at
                      ///< `reference_checkpoint`s; 0 = by samples
    std::string part = "out.radiance";
    int max_samples = 1 << 16; ///< when the noise is not reached before
};

struct ReferenceProgress {
    double share = 0;         ///< 0 … 1, of the whole goal as far as it can be told
    double seconds_left = -1; ///< −1 while it is not known
    int samples = 0;          ///< that every pixel has
    double noise = 0;         ///< the last one measured; 0 = none yet
    double rays_per_second = 0;
};

struct ReferenceResult {
    LayeredImage image;
    int samples = 0;
    double noise = 0;      ///< of the goal's part
    bool complete = false; ///< false: stopped before the goal; what was rendered is in `image` and kept for a later run
    bool cached = false;   ///< nothing had to be rendered
    int resumed_from = 0;  ///< samples a pixel that an earlier run had left
    std::string kept_problem; ///< why the state could not be kept for later ("" = it was)
};

/// Sample counts at which noise is measured: 16, 24, 32, 48, 64, 96 … The next one after `samples`.
int reference_checkpoint(int samples);

/// Renders the goal. `on_progress` is called some ten times a second from the calling thread; returning false stops.
/// The result is a function of shot, settings and goal alone, whether it comes from the cache or not. With `use_cache`
/// off nothing is read or written beside. Throws Error on bad input.
ReferenceResult reference_image(const Shot& shot, const ReferenceSettings& settings, int frame,
                                const ReferenceGoal& goal,
                                const std::function<bool(const ReferenceProgress&)>& on_progress,
                                bool use_cache = true);

/// Where states are kept (below cache_folder(); created when absent), and how many bytes they may take together: the
/// oldest go first.
std::filesystem::path reference_cache_folder();
constexpr uint64_t k_reference_cache_bytes = uint64_t(4) << 30;

} // namespace bounce
