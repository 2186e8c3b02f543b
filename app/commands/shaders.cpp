// bounce shaders: expands every program of every graph to standalone files (for other compilers to judge).
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/listing.h"
#include "app/print.h"
#include "core/error.h"
#include "core/image.h"
#include "core/paths.h"
#include "graph/model.h"

#include <algorithm>
#include <set>

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

/// "surface/direct.comp" → "surface.direct.comp".
std::string flat(const fs::path& stage) {
    std::string name = stage.string();
    std::replace(name.begin(), name.end(), '/', '.');
    return name;
}

class ExpandedFiles {
  public:
    explicit ExpandedFiles(fs::path folder) : folder_(std::move(folder)) { fs::create_directories(folder_); }

    /// `owner`: "GRAPH.PASS", or with what is there "GRAPH.PASS+SLOT".
    void write(std::string owner, const fs::path& stage, const std::string& text) {
        std::replace(owner.begin(), owner.end(), '/', '-'); // of presets
        stages_.insert(flat(stage));
        if (!names_.insert(owner + "." + flat(stage)).second) return;
        write_file_atomically(folder_ / (owner + "." + flat(stage)), text);
    }
    bool has(const fs::path& stage) const { return stages_.contains(flat(stage)); }
    size_t count() const { return names_.size(); }

  private:
    fs::path folder_;
    std::set<std::string> stages_, names_;
};

/// The optional slots that a pass's shaders ask for by name: HAS_slot is defined where something makes what is there.
std::set<std::string> asked_for(const PassNode& node) {
    std::set<std::string> names;
    for (const auto& program : node.programs)
        for (const ShaderSlot& slot : program->slots())
            for (const ShaderSource& source : program->sources())
                if (slot.optional && source.text.find("HAS_" + slot.identifier) != std::string::npos)
                    names.insert(slot.identifier);
    return names;
}

void expand_pass(GraphModel& model, PassNode& node, const std::set<std::string>& present, ExpandedFiles& files) {
    Defines defines;
    for (const auto& program : node.programs)
        add_formats(*program, defines);
    std::string owner = model.file().name + "." + node.id();
    for (const std::string& slot : present) {
        defines["HAS_" + slot] = "1";
        owner += "+" + slot;
    }
    model.scan(node, defines);
    for (const auto& program : node.programs)
        add_formats(*program, defines); // of slots that are there only now
    model.scan(node, defines);
    for (const auto& program : node.programs) {
        if (!program->errors().empty()) throw Error(program->errors().front().text());
        for (size_t i = 0; i < program->sources().size(); ++i) {
            const std::string& text = program->sources()[i].text;
            // Stages that do not ask are the same whatever is there, but for the line that defines it.
            auto asks = [&](const std::string& slot) { return text.find("HAS_" + slot) != text.rfind("HAS_" + slot); };
            if (present.empty() || std::any_of(present.begin(), present.end(), asks))
                files.write(owner, program->stages()[i], text);
        }
    }
}

/// With none of what is optional, with each alone, and with all.
void expand_graph(GraphModel& model, ExpandedFiles& files) {
    for (const auto& node : model.nodes()) {
        expand_pass(model, *node, {}, files);
        const std::set<std::string> slots = asked_for(*node);
        for (const std::string& slot : slots)
            expand_pass(model, *node, {slot}, files);
        if (slots.size() > 1) expand_pass(model, *node, slots, files);
    }
}

int expand_all(const std::string& folder) {
    ExpandedFiles files(folder);
    for (const std::string& name : names_of("graphs")) {
        GraphModel model(read_graph_file(find_graph(name)));
        expand_graph(model, files);
    }
    // Those that no graph uses: the program's own (the viewport, the check for NaN), with their defines' defaults.
    for (const auto& entry : fs::recursive_directory_iterator(glsl_folder())) {
        std::string extension = entry.path().extension().string();
        if (extension != ".comp" && extension != ".vert" && extension != ".geom" && extension != ".frag") continue;
        fs::path stage = entry.path().lexically_relative(glsl_folder());
        if (files.has(stage)) continue;
        Program program("alone", {stage}, glsl_folder());
        program.scan({}, {});
        Defines formats;
        add_formats(program, formats);
        program.scan(formats, {});
        if (!program.errors().empty()) throw Error(program.errors().front().text());
        files.write("alone", stage, program.sources().front().text);
    }
    print("{} shaders in {}\n", files.count(), folder);
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
