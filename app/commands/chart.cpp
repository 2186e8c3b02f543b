// bounce chart: error against time, over shots, graphs and parameters.
#include "app/experiments/chart.h"
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/commands/session_options.h"
#include "app/experiments/method_report.h"
#include "app/experiments/sweep.h"
#include "app/hosts/headless.h"
#include "app/listing.h"
#include "app/print.h"
#include "core/error.h"
#include "core/scanner.h"
#include "core/text.h"
#include "scene/find_scene.h"
#include "scene/shot.h"

#include <fmt/format.h>

namespace bounce {

namespace {

struct ChartArguments {
    SessionArguments session; ///< of every point
    std::vector<std::string> shots, merge, parts;
    std::string graphs = k_default_graph, sweep, output, shard, against, metric, results;
    std::optional<int> warm_up, frames;
    int samples = 0;
    std::string reference = "cpu";
    std::optional<double> noise;
    bool resume = true;
    bool all = false, quick = false;
};

void print_line(const std::string& line) {
    print("{}\n", line);
    std::fflush(stdout);
}

/// Every shot through every graph with every combination of the sweep.
std::vector<PointTask> tasks_of_sweep(const ChartArguments& a, ChartView& view) {
    if (a.shots.empty()) throw Error("chart: expected at least one shot");
    for (const std::string& shot : a.shots)
        find_shot(shot);
    SessionOptions options = a.session.options();
    if (!options.size) options.size = glm::ivec2(320, 180);
    Sweep sweep;
    if (!a.sweep.empty()) sweep = load_sweep(a.sweep);
    if (a.metric.empty() && !sweep.metric.empty()) view.metric = sweep.metric;
    const std::vector<ParameterValues> combinations = sweep.combinations();
    std::vector<PointTask> tasks;
    for (const std::string& shot : a.shots) {
        for (const std::string& graph : split(a.graphs, ',')) {
            find_graph(graph); // a wrong name is told before anything is computed
            for (const ParameterValues& values : combinations) {
                PointTask task;
                task.session = options;
                task.session.shot = shot;
                task.session.graph = graph;
                task.session.sets.insert(task.session.sets.end(), values.begin(), values.end());
                task.session.switches.insert(task.session.switches.begin(), sweep.switches.begin(),
                                             sweep.switches.end());
                task.parts = a.parts;
                tasks.push_back(task);
            }
        }
        load_shot(shot);
    }
    return tasks;
}

/// Those of the sweep that holds all methods.
std::vector<PointTask> tasks_of_suite(const ChartArguments& a, const MethodSuite& suite) {
    const SessionOptions options = a.session.options();
    if (!options.sets.empty() || !options.switches.empty() || !a.parts.empty())
        throw Error("chart --all: its sweep says what is set, switched and compared; expected no --set, --enable, "
                    "--disable or --resource");
    std::vector<std::string> skipped;
    std::vector<PointTask> tasks = suite.tasks(a.quick, a.shots, skipped);
    for (const std::string& line : skipped)
        print_line(line);
    for (PointTask& task : tasks) {
        find_graph(task.session.graph);
        if (options.size) task.session.size = options.size;
        task.session.material_model = options.material_model;
    }
    return tasks;
}

int run(const ChartArguments& a) {
    ChartView view;
    view.against = a.against;
    if (!a.metric.empty()) view.metric = find_metric(a.metric).name;
    if (a.quick && !a.all) throw Error("chart --quick: expected --all with it");
    if (!a.results.empty() && !a.all) throw Error("chart --results: expected --all with it");
    std::optional<MethodSuite> suite;
    if (a.all) {
        suite = load_method_suite(a.sweep.empty() ? k_all_methods : a.sweep);
        if (a.metric.empty()) view.metric = suite->metric;
    }
    const std::filesystem::path results = a.results.empty() ? a.output : a.results;
    const AlsoWrite also_write = [&](const std::vector<ChartPoint>& points) {
        if (suite) write_method_report(*suite, points, results, view);
    };
    if (!a.merge.empty()) {
        std::vector<std::filesystem::path> folders(a.merge.begin(), a.merge.end());
        merge_charts(folders, a.output, view, print_line, also_write);
        print("{}/chart.html\n", a.output);
        return 0;
    }
    ChartPlan plan;
    plan.tasks = suite ? tasks_of_suite(a, *suite) : tasks_of_sweep(a, view);
    plan.folder = a.output;
    plan.view = view;
    plan.also_write = also_write;
    plan.resume = a.resume;
    if (!a.shard.empty()) std::tie(plan.shard, plan.shards) = parse_shard(a.shard);
    for (PointTask& task : plan.tasks) {
        task.warm_up = a.warm_up.value_or(task.warm_up);
        task.frames = a.frames.value_or(task.frames);
        task.reference_noise = a.noise.value_or(task.reference_noise);
        task.reference_samples = a.samples;
        task.device_reference = a.reference == "device";
    }
    HeadlessContext context(a.session.device);
    run_chart(plan, print_line);
    print("{}/chart.html\n", a.output);
    return 0;
}

} // namespace

void add_chart_command(CLI::App& app, CommandFunction& chosen) {
    auto* command = app.add_subcommand("chart", "chart error against time over shots, graphs and parameters");
    auto a = std::make_shared<ChartArguments>();
    command->add_option("shots", a->shots, "shots or scenes; with --all: only these of its scenes")->type_name("SHOT");
    command->add_option("--graphs,-g", a->graphs, "graphs, separated by commas")
        ->type_name("GRAPHS")
        ->check(not_empty())
        ->capture_default_str();
    command->add_option("--sweep", a->sweep, "a sweep: name or .json (base values and lists to permute)")
        ->type_name("SWEEP")
        ->check(not_empty());
    a->session.add_settings_to(*command);
    command
        ->add_option(
            "--resource", a->parts,
            "compare this part (out.ambient_occlusion) instead of what the graph's transport says; repeatable: "
            "their sum")
        ->allow_extra_args(false);
    command->add_option("--warmup", a->warm_up, "frames before timing starts")
        ->check(whole_between(0, 100000))
        ->default_str("3");
    command->add_option("--frames", a->frames, "frames that are timed")
        ->check(whole_between(1, 100000))
        ->default_str("10");
    command->add_option("--noise", a->noise, "relative noise of the references")
        ->check(number_between(1e-6, 1))
        ->default_str("0.01");
    command->add_flag("--all", a->all, "every method, as the sweep all_methods (or --sweep) says");
    command->add_flag("--quick", a->quick, "with --all: fewer scenes and settings, and smaller pictures");
    command->add_option("--results", a->results, "with --all: the folder for methods.* and gallery.* (the output)")
        ->type_name("FILE")
        ->check(not_empty());
    command->add_option("--spp", a->samples, "samples a pixel of the references, instead of --noise")
        ->check(whole_between(2, 1 << 20));
    command->add_option("--reference", a->reference, "who renders the references: cpu, or device by path_traced")
        ->type_name("WHO")
        ->check(one_of({"cpu", "device"}))
        ->capture_default_str();
    command->add_option("--shard", a->shard, "i/n: measure only every n-th point, from the i-th (0 … n − 1)")
        ->check(shard());
    command
        ->add_option("--against", a->against,
                     "draw the error over this parameter (d_max, or hbao_dmax.d_max) instead of over time")
        ->check(not_empty());
    command->add_option("--metric", a->metric, "draw errors by this metric (bounce list metrics)")
        ->type_name("METRIC")
        ->check(one_of(names_of("metrics")));
    command->add_flag("--resume,!--no-resume", a->resume,
                      "keep points that are measured already (the default), or measure all again");
    command->add_option("--merge", a->merge, "join the points of these folders instead of measuring")
        ->type_name("FILE");
    command->add_option("-o,--output", a->output, "the folder for chart.csv, .json, .svg, .html, .md and the points")
        ->type_name("FILE")
        ->required();
    command->callback([a, &chosen] { chosen = [a] { return run(*a); }; });
}

} // namespace bounce
