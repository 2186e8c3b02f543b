#include "app/experiments/method_report.h"

#include "app/experiments/method_gallery.h"
#include "app/experiments/method_text.h"
#include "app/experiments/report.h"
#include "core/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

namespace fs = std::filesystem;

static void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw Error("cannot create the folder '" + folder.string() + "': " + error.message());
}

void write_method_report(const MethodSuite& suite, std::vector<ChartPoint> points, const fs::path& folder,
                         const ChartView& view) {
    const Metric& metric = find_metric(view.metric);
    mark_pareto(points, metric);
    const std::string head = head_of(points);
    make_folder(folder / "methods");
    make_folder(folder / "gallery");
    for (const MethodGroup& group : suite.groups) {
        std::vector<ChartPoint> own;
        std::copy_if(points.begin(), points.end(), std::back_inserter(own), [&](auto& p) { return group.holds(p); });
        if (!own.empty())
            write_file_atomically(folder / "methods" / (group.name + ".svg"), with_head(svg_scatter(own, view), own));
    }
    for (const MethodScene& scene : suite.scenes)
        if (const std::string svg = gallery_svg(suite, scene, points, metric); !svg.empty())
            write_file_atomically(folder / "gallery" / gallery_file(scene), with_head(svg, points));
    write_file_atomically(folder / "methods.csv", chart_csv(points));
    write_file_atomically(folder / "methods.html", methods_page(suite, points, head));
    write_file_atomically(folder / "gallery.md", gallery_markdown(suite, points, metric, head));
    write_file_atomically(folder / "methods.md", methods_markdown(suite, points, metric, head));
}

} // namespace bounce
