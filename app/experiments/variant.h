#pragma once
// A shot through a graph with other settings, one after the other: what each costs, and how far it is from the same
// reference. Experiments that compare settings (ablate, tune) measure by it.

#include "app/session.h"
#include "core/image.h"

#include <functional>
#include <map>
#include <memory>

namespace bounce {

/// What differs from the graph as its file has it.
struct Variant {
    std::map<std::string, std::string> sets; ///< "pass.name" → --set text
    std::map<std::string, bool> switches;    ///< pass → on or off
    bool operator==(const Variant&) const = default;
    auto operator<=>(const Variant&) const = default;
    /// "gather.interleave=4, filter off"; "as it is" for none.
    std::string text() const;
};

/// Sets parameters that may come and go with the choices of each other, those that are there first. `before` is told
/// the name of each. Throws Error when one is not there in the end.
void set_parameters(GraphModel& model, const std::map<std::string, std::string>& sets,
                    const std::function<void(const std::string&)>& before = {});

struct VariantFigures {
    double ms = 0;                      ///< a frame
    uint64_t bytes = 0;                 ///< of the plan
    double error = 0, error_spread = 0; ///< relative RMSE without the reference's noise; its standard deviation over
                                        ///< the frames, where the shot stands still
    double bias = 0;
    double flicker = 0; ///< RMS of the second difference of luminance over frames, over its mean; 0 below 3 frames
    Image picture;      ///< of the parts that are compared, last frame
};

class VariantMeasurer {
  public:
    /// Opens the shot and renders its reference of the graph's own transport, with so many samples a pixel. `options`
    /// holds for every variant. Throws Error.
    VariantMeasurer(const SessionOptions& options, int samples, int frames);
    ~VariantMeasurer();

    /// Throws Error where the graph does not work so; the measurer then stays usable.
    VariantFigures measure(const Variant& variant);

    Session& session() { return *session_; }
    const Image& reference() const { return truth_part_; }

    /// The session's graph is that of the variant from here on. Parameters may come and go with the choices of others;
    /// throws Error when one that the variant sets is not there in the end.
    void use(const Variant& variant);

  private:
    struct Own {
        std::string text;
        ParameterOrigin origin;
    };

    std::unique_ptr<Session> session_;
    int frames_;
    bool still_ = false;
    std::map<std::string, Own> own_sets_; ///< of parameters that the variant in use sets: what they were before any
    std::map<std::string, bool> own_switches_;
    std::string parts_;
    LayeredImage truth_;
    Image truth_part_;
};

} // namespace bounce
