#include "app/ui/snapshots.h"

#include "app/experiments/html_page.h"
#include "app/experiments/svg_scatter.h"
#include "app/graph_difference.h"
#include "app/graph_preset.h"
#include "app/ui/live_comparison.h"
#include "app/ui/settings_key.h"
#include "app/ui/shot_writer.h"
#include "core/base64.h"
#include "core/error.h"
#include "core/text.h"
#include "gpu/barrier.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

namespace {

Image8 display_of(const Session& session) {
    const GpuTexture* display = session.graph().texture("out.display");
    if (!display || !*display) throw Error("the graph makes no out.display, of which a snapshot could be taken");
    const glm::ivec3 size = display->desc().size;
    Image8 picture{size.x, size.y, std::vector<uint8_t>(size_t(size.x) * size_t(size.y) * 4)};
    memory_barrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGetTextureImage(display->id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(picture.rgba.size()), picture.rgba.data());
    for (size_t i = 3; i < picture.rgba.size(); i += 4)
        picture.rgba[i] = 255;
    return picture;
}

void add_figures(Snapshot& snapshot, const Session& session, const LiveComparison* comparison) {
    const Graph& graph = session.graph();
    snapshot.ms = whole_frame_ms(graph);
    snapshot.ms_current = times_are_current(graph);
    snapshot.bytes = graph.plan().total_bytes();
    for (const PlanPass& pass : graph.plan().passes)
        snapshot.passes.emplace_back(pass.id, graph.timing(pass.id).median);
    if (!comparison || !comparison->measured() || comparison->stale(session)) return;
    const bool occlusion = comparison->only_occlusion();
    for (const Metric* metric : brief_metrics()) {
        const Metric& shown = metric_for(*metric, occlusion);
        if (comparison->figures().find(shown.name))
            snapshot.figures.emplace_back(shown.title, metric_text(shown, comparison->figures(), occlusion));
    }
}

/// Lines of `a` that `b` lacks with a minus, those of `b` that `a` lacks with a plus.
std::string lines_apart(const std::string& a, const std::string& b) {
    const std::vector<std::string> first = split(a, '\n'), second = split(b, '\n');
    std::string out;
    const auto lacking = [&](const char* sign, const auto& from, const auto& in) {
        for (const std::string& line : from)
            if (std::find(in.begin(), in.end(), line) == in.end()) out += sign + line + "\n";
    };
    lacking("- ", first, second);
    lacking("+ ", second, first);
    return out;
}

} // namespace

const GpuTexture* Snapshots::texture(int index) {
    if (index < 0 || index >= int(all.size())) return nullptr;
    Snapshot& snapshot = all[size_t(index)];
    if (!snapshot.texture) {
        const Image8& picture = snapshot.picture;
        snapshot.texture =
            GpuTexture({TextureKind::texture_2d, GL_RGBA8, {picture.width, picture.height, 1}, 1}, "snapshot");
        glTextureSubImage2D(snapshot.texture.id(), 0, 0, 0, picture.width, picture.height, GL_RGBA, GL_UNSIGNED_BYTE,
                            picture.rgba.data());
        glTextureParameteri(snapshot.texture.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    return &snapshot.texture;
}

void Snapshots::remove(int index) {
    all.erase(all.begin() + index);
    for (int* side : {&left, &right}) {
        if (*side == index) view = SnapshotView::off;
        if (*side >= index) *side = *side == index ? -1 : *side - 1;
    }
}

void Snapshots::release_gpu() {
    for (Snapshot& snapshot : all)
        snapshot.texture = {};
}

void take_snapshot(PanelContext& context) {
    context.session.finish_frame();
    const Session& session = context.session;
    if (!context.ui.snapshots) context.ui.snapshots = std::make_shared<Snapshots>();
    Snapshots& snapshots = *context.ui.snapshots;
    Snapshot snapshot;
    snapshot.picture = display_of(session);
    snapshot.graph = session.graph().model().file().name;
    snapshot.graph_text = graph_as_set(session).dump();
    snapshot.shot_text = shot_text(session, context.ui.window.opened, session.shot().path.parent_path());
    snapshot.command = reproducing_command(context);
    add_figures(snapshot, session, context.ui.comparison.get());
    snapshot.name = fmt::format("{}: {}", ++snapshots.taken, snapshot.graph);
    snapshots.all.push_back(std::move(snapshot));
    context.ui.say("snapshot " + snapshots.all.back().name);
}

std::string snapshot_difference(const Snapshot& a, const Snapshot& b) {
    std::string out = graph_difference(a.graph, in_file_order(OrderedJson::parse(a.graph_text)),
                                       in_file_order(OrderedJson::parse(b.graph_text)));
    const std::string shot = lines_apart(a.shot_text, b.shot_text);
    if (!out.empty() && !shot.empty()) out += "\n";
    return out + shot;
}

std::string snapshots_page(const Snapshots& snapshots) {
    std::string out = "<h1>Snapshots</h1>\n";
    for (const Snapshot& snapshot : snapshots.all) {
        out += fmt::format("<section><h2>{}</h2>\n<img alt=\"\" src=\"data:image/png;base64,{}\">\n",
                           escape_markup(snapshot.name), base64(encode_png(snapshot.picture)));
        out += fmt::format("<p>{:.3f} ms{}, {}", snapshot.ms, snapshot.ms_current ? "" : " (of earlier settings)",
                           format_bytes(double(snapshot.bytes)));
        for (const auto& [title, text] : snapshot.figures)
            out += fmt::format(", {} {}", escape_markup(title), escape_markup(text));
        out += "</p>\n";
        if (!snapshot.command.empty()) out += "<p><code>" + escape_markup(snapshot.command) + "</code></p>\n";
        if (&snapshot != &snapshots.all.front()) {
            const std::string apart = snapshot_difference(snapshots.all.front(), snapshot);
            out += fmt::format("<p>Against {}:</p>\n<pre>{}</pre>\n", escape_markup(snapshots.all.front().name),
                               escape_markup(apart.empty() ? "the same settings" : apart));
        }
        out += "<table class=\"narrow\"><tr><th>pass</th><th>ms</th></tr>\n";
        for (const auto& [pass, ms] : snapshot.passes)
            out += fmt::format("<tr><td>{}</td><td>{:.3f}</td></tr>\n", escape_markup(pass), ms);
        out += "</table></section>\n";
    }
    return html_page({"snapshots", out, "null", {"pictures", "snapshots"}});
}

} // namespace bounce
