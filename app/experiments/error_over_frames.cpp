#include "app/experiments/error_over_frames.h"

#include "app/capture.h"
#include "core/error.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace bounce {

namespace {

/// 1, 4, 16, 64, …
bool is_power_of_four(int frames) {
    return std::has_single_bit(unsigned(frames)) && std::countr_zero(unsigned(frames)) % 2 == 0;
}

bool has_part(const LayeredImage& image, const std::string& part) {
    try {
        part_of(image, part, "the picture");
        return true;
    } catch (const Error&) {
        return false;
    }
}

} // namespace

ErrorOverFrames::ErrorOverFrames(const std::string& reference, std::string part) : part_(std::move(part)) {
    bool display = false;
    reference_ = read_picture(reference, display);
    if (display) throw Error("invalid --reference '" + reference + "': expected an .exr of linear radiance");
    if (!part_.empty()) part_of(reference_, part_, "'" + reference + "'"); // tells what there is
}

void ErrorOverFrames::add(const Session& session, int frames, bool last) {
    if (!last && !is_power_of_four(frames)) return;
    const LayeredImage picture = averaged_to_size_of(reference_, read_parts(session));
    ComparisonOptions options;
    options.window = 3;
    options.shown = false;
    for (const std::string& part : session.graph().model().file().transport.parts)
        if (has_part(picture, part) && has_part(reference_, part)) options.parts.push_back(part);
    if (!part_.empty()) options.parts = {part_};
    if (options.parts.empty()) throw Error("the reference has none of the parts that the graph makes");
    for (const PartComparison& compared : compare_layers(picture, reference_, options).parts) {
        if (compared.figures["reference_mean"] == 0) continue;
        text_ += fmt::format("after {} frame{}: {}: bias {:+.1f} %, RMSE {:.1f} %, of 3x3 means {:.1f} %\n", frames,
                             frames == 1 ? "" : "s", compared.part, 100 * compared.figures["bias"],
                             100 * compared.figures["relative_rmse"], 100 * compared.windowed["relative_rmse"]);
    }
}

} // namespace bounce
