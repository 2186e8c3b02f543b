// bounce without arguments: a shot with global illumination, in a window where there is a display. Else to a picture,
// with what it costs and how far it is from the truth.
#include "app/broken_shaders.h"
#include "app/capture.h"
#include "app/commands/command.h"
#include "app/experiments/report.h"
#include "app/experiments/transport.h"
#include "app/hosts/headless.h"
#include "app/print.h"
#include "app/progress.h"
#include "core/error.h"
#include "core/text.h"
#include "reference/reference_image.h"

#include <cstdlib>
#include <fmt/format.h>

namespace bounce {

namespace {

constexpr int k_frames = 3;          // the first one compiles
const glm::ivec2 k_size{640, 360};   // seconds per frame without a GPU
constexpr int k_reference_share = 4; // of the picture's width and height: a first look does not wait for minutes
constexpr int k_reference_samples = 64;

bool display_is_there() {
    for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"}) {
        const char* value = std::getenv(name);
        if (value && *value) return true;
    }
    return false;
}

/// The errors of the present picture, as means over the pixels of a small reference of the same transport.
std::string errors_of(const Session& session) {
    const GraphModel& model = session.graph().model();
    Shot shot = session.shot();
    shot.width = session.size().x / k_reference_share;
    shot.height = session.size().y / k_reference_share;
    ReferenceGoal goal;
    goal.samples = k_reference_samples;
    Progress bar("path tracing what it is compared with");
    const ReferenceResult truth =
        reference_image(shot, transport_settings(model), session.frame(), goal, [&](const ReferenceProgress& progress) {
            bar.update(progress.share);
            return true;
        });
    const std::string part = join(model.file().transport.parts, "+");
    ComparisonOptions options;
    options.parts = {part};
    options.absent_is_black = true;
    options.shown = false;
    const LayerComparison comparison =
        compare_layers(averaged_to_size_of(truth.image, read_parts(session)), truth.image, options);
    return error_summary(comparison.parts.front().figures, !is_radiance(part));
}

int render_default() {
    const std::string output = std::string(k_default_shot) + ".png";
    check_output_path(output);
    HeadlessContext context(-1);
    SessionOptions options;
    options.graph = k_first_graph;
    options.size = k_size;
    Session session(options);
    Progress bar("rendering");
    for (int frame = 0; frame < k_frames; ++frame) {
        if (frame > 0) session.advance();
        if (frame == 1) session.graph().forget_timings();
        session.render(true);
        bar.update(double(frame + 1) / k_frames);
    }
    throw_if_broken(session, "nothing was written");
    write_picture(session, output);
    session.graph().finish_timings();
    print("{}: {} through {}, {:.3g} ms per frame, {}; against a path tracer, {} samples per pixel: {}\n", output,
          options.shot, options.graph, session.graph().frame_ms(),
          format_bytes(double(session.graph().plan().total_bytes())), k_reference_samples, errors_of(session));
    return 0;
}

} // namespace

int run_default() {
    return display_is_there() ? view_default() : render_default();
}

} // namespace bounce
