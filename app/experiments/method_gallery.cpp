#include "app/experiments/method_gallery.h"

#include "app/experiments/method_text.h"
#include "app/experiments/svg_scatter.h"
#include "core/printable.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

namespace {

constexpr int k_columns = 9, k_tile = 128, k_gap = 8, k_line = 13, k_heading = 26;

std::string class_text(double ms) {
    return ms < 1000 ? fmt::format("{:g} ms", ms) : fmt::format("{:g} s", ms / 1000);
}

struct Row {
    std::string title;
    std::vector<const ChartPoint*> shown; ///< by graph
    std::vector<std::string> absent;      ///< graphs that have no point within the time
};

std::vector<Row> rows_of(const MethodSuite& suite, const MethodScene& scene, const std::vector<ChartPoint>& points,
                         const Metric& metric) {
    std::vector<Row> rows;
    for (double ms : k_gallery_classes) {
        for (const MethodGroup& group : suite.groups) {
            const auto scores = scores_of(points_of(points, scene, group),
                                          [&](const ChartPoint& p) { return std::optional(p.error(metric)); });
            if (scores.empty()) continue;
            Row& row = rows.emplace_back();
            row.title = fmt::format("within {}: {}", class_text(ms), group.title);
            const auto within = best_within(scores, ms);
            for (const auto& [graph, best] : best_of_graphs(scores)) {
                if (const auto found = within.find(graph); found != within.end())
                    row.shown.push_back(found->second.point);
                else
                    row.absent.push_back(graph);
            }
        }
    }
    return rows;
}

/// Pictures that are kept once, however often they are shown.
class Pictures {
  public:
    explicit Pictures(glm::ivec2 size) : height_(k_tile * size.y / size.x), size_(size) {}
    int height() const { return height_; }

    std::string show(const std::string& png, int x, int y) {
        const auto [found, added] = ids_.emplace(png, ids_.size());
        if (added)
            kept_ += fmt::format("<image id=\"p{}\" width=\"{}\" height=\"{}\" style=\"image-rendering:pixelated\" "
                                 "preserveAspectRatio=\"none\" href=\"data:image/png;base64,{}\"/>\n",
                                 found->second, k_tile, height_, escape_markup(png));
        return fmt::format("<use href=\"#p{}\" x=\"{}\" y=\"{}\"/>\n", found->second, x, y);
    }
    std::string kept() const { return "<defs>\n" + kept_ + "</defs>\n"; }

  private:
    int height_;
    glm::ivec2 size_;
    std::map<std::string, size_t> ids_;
    std::string kept_;
};

std::string line(int x, int y, const std::string& text, const char* look = "") {
    return fmt::format("<text x=\"{}\" y=\"{}\" {}>{}</text>\n", x, y, look, escape_markup(text));
}

} // namespace

std::string gallery_file(const MethodScene& scene) {
    std::string name = scene.shot;
    std::replace(name.begin(), name.end(), '/', '_');
    return name + ".svg";
}

std::string gallery_svg(const MethodSuite& suite, const MethodScene& scene, const std::vector<ChartPoint>& points,
                        const Metric& metric) {
    std::vector<Row> rows = rows_of(suite, scene, points, metric);
    std::erase_if(rows, [](const Row& row) { return row.shown.empty(); });
    if (rows.empty()) return "";
    Pictures pictures(rows.front().shown.front()->task.size());
    const int tile_height = 2 * pictures.height() + 4 * k_line + k_gap;
    std::string body;
    int y = 0;
    for (const Row& row : rows) {
        body += line(0, y + 18, row.title, "font-size=\"15\" font-weight=\"bold\"");
        y += k_heading;
        int column = 1;
        body += pictures.show(row.shown.front()->reference_png, 0, y);
        body += line(0, y + pictures.height() + k_line, "reference");
        for (const ChartPoint* point : row.shown) {
            if (column == k_columns) {
                column = 0;
                y += tile_height;
            }
            const int x = column++ * (k_tile + k_gap), below = y + 2 * pictures.height();
            body += pictures.show(point->thumbnail_png, x, y);
            body += pictures.show(point->error_png, x, y + pictures.height());
            body += line(x, below + k_line, point->task.session.graph, "font-weight=\"bold\"");
            body +=
                line(x, below + 2 * k_line, fmt::format("{:.3g} ms, {}", point->total_ms, error_text(*point, metric)));
            body += line(x, below + 3 * k_line, "bias " + error_text(*point, find_metric("bias")));
        }
        y += tile_height;
    }
    const int width = k_columns * (k_tile + k_gap);
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
                       "font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" "
                       "fill=\"white\"/>\n",
                       width, y) +
           pictures.kept() + body + "</svg>\n";
}

std::string gallery_markdown(const MethodSuite& suite, const std::vector<ChartPoint>& points, const Metric& metric,
                             const std::string& head) {
    std::string out = "# All methods at equal time\n\n" + head + "\n";
    out += fmt::format("For each scene, within {} and within {} a frame: the reference of what a group of methods is "
                       "held to, then each "
                       "graph's most accurate point within that time, over its relative error in false colours (0 … 50 "
                       "%). The caption "
                       "tells time, {} and bias. Pictures show what is compared (indirect light alone, say), with one "
                       "exposure a group.\n\n",
                       class_text(k_gallery_classes[0]), class_text(k_gallery_classes[1]), metric.title);
    for (const MethodScene& scene : suite.scenes) {
        const std::vector<Row> rows = rows_of(suite, scene, points, metric);
        if (rows.empty()) continue;
        out += fmt::format("## {0}\n\n![{0} by all methods](gallery/{1})\n\n", scene.shot, gallery_file(scene));
        if (!scene.seen.empty()) out += "What one sees: " + markdown_cell(scene.seen) + "\n\n";
        for (const Row& row : rows)
            if (!row.absent.empty()) out += fmt::format("- {}: no point of {}\n", row.title, join(row.absent, ", "));
        out += "\n";
    }
    return out;
}

} // namespace bounce
