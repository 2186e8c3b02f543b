// bounce shaders: expands every program of every graph to standalone files (for other compilers to judge).
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/print.h"
#include "core/error.h"
#include "core/image.h"
#include "core/paths.h"
#include "graph/model.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

namespace {
namespace fs = std::filesystem;

/// Formats as the file's resources and the passes' declarations have them do not matter to a compiler's judgement of
/// the rest, but the layout qualifier must be one that goes with the image's type.
void add_formats(const Program& program, Defines& formats) {
    for (const ShaderSlot& slot : program.slots()) {
        if (slot.kind != SlotKind::image) continue;
        bool integer = slot.type.starts_with("u"),
             is_signed = slot.type.starts_with("i") && !slot.type.starts_with("image");
        formats["FORMAT_" + slot.identifier] = integer ? "r32ui" : is_signed ? "r32i" : "rgba16f";
    }
}

int expand_all(const std::string& folder) {
    fs::create_directories(folder);
    int count = 0;
    std::vector<std::string> done;
    for (const auto& entry : fs::directory_iterator(assets_folder() / "graphs")) {
        if (entry.path().extension() != ".json") continue;
        GraphModel model(read_graph_file(entry.path()));
        for (const auto& node : model.nodes()) {
            Defines formats;
            for (const auto& program : node->programs)
                add_formats(*program, formats);
            model.scan(*node, formats);
            for (const auto& program : node->programs) {
                if (!program->errors().empty()) throw Error(program->errors().front().text());
                for (size_t i = 0; i < program->sources().size(); ++i) {
                    std::string name = program->stages()[i].string();
                    std::replace(name.begin(), name.end(), '/', '.');
                    name = model.file().name + "." + node->id() + "." + name;
                    if (std::find(done.begin(), done.end(), name) != done.end()) continue;
                    done.push_back(name);
                    write_file_atomically(fs::path(folder) / name, program->sources()[i].text);
                    ++count;
                }
            }
        }
    }
    // Those that no graph uses: the program's own (the viewport, the check for NaN), with their defines' defaults.
    for (const auto& entry : fs::recursive_directory_iterator(glsl_folder())) {
        std::string extension = entry.path().extension().string();
        if (extension != ".comp" && extension != ".vert" && extension != ".geom" && extension != ".frag") continue;
        fs::path stage = entry.path().lexically_relative(glsl_folder());
        std::string name = stage.string();
        std::replace(name.begin(), name.end(), '/', '.');
        if (std::any_of(done.begin(), done.end(), [&](auto& d) { return d.ends_with("." + name); })) continue;
        Program program("alone", {stage}, glsl_folder());
        program.scan({}, {});
        Defines formats;
        add_formats(program, formats);
        program.scan(formats, {});
        if (!program.errors().empty()) throw Error(program.errors().front().text());
        write_file_atomically(fs::path(folder) / ("alone." + name), program.sources().front().text);
        ++count;
    }
    print("{} shaders in {}\n", count, folder);
    return 0;
}
} // namespace

void add_shaders_command(CLI::App& app, CommandFunction& chosen) {
    auto* command = app.add_subcommand("shaders", "expand the shaders of every graph to standalone files");
    auto folder = std::make_shared<std::string>();
    command->add_option("--expand", *folder, "the folder to write to")
        ->type_name("FILE")
        ->check(not_empty())
        ->required();
    command->callback([folder, &chosen] { chosen = [folder] { return expand_all(*folder); }; });
}

} // namespace bounce
