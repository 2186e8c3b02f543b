#include "app/new_pass.h"

#include "core/error.h"
#include "core/image.h"
#include "core/paths.h"
#include "core/scanner.h"
#include "graph/graph_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace bounce {

namespace fs = std::filesystem;

// The placeholder @ is the pass's name.
static const char* const k_shader = R"(// What this pass computes, in one sentence.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D out_radiance;                              // read: the resource out.radiance
layout(FORMAT_@_result) writeonly uniform image2D @_result;  // written: @.result, declared in the graph file

uniform float strength = 1.0;               //! [0, 2] how much of the tint is applied
uniform vec3 tint = vec3(1.0, 0.8, 0.6);    //! what the picture is multiplied by

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(@_result)))) return;
    vec3 radiance = texelFetch(out_radiance, pixel, 0).rgb;
    imageStore(@_result, pixel, vec4(radiance * mix(vec3(1.0), tint, strength), 1.0));
}
)";

static const char* const k_cpp = R"(// What this pass computes, in one sentence.
#include "graph/context.h"

namespace bounce {

class @_pass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("main", {"user/@.comp"});
        description.parameters.add("scale", scale_, {0.1, 1.0}, "", "size of the result as a share of the picture's");
    }

    void declare(Declaration& d) override {
        d.uses("main");
        d.creates("@.result", ResourceKind::texture_2d, "rgba16f",
                  {int(float(d.size.x) * scale_), int(float(d.size.y) * scale_)})
            .radiance = true; // shown in W/(sr·m²); without this line, as stored
    }

    void execute(PassContext& c) override { c.dispatch("main", c.size("@.result")); }

  private:
    float scale_ = 1.0f;
};

BOUNCE_REGISTER_PASS("@", @_pass, "what this pass computes, in one sentence")

} // namespace bounce
)";

static std::string filled(std::string text, const std::string& name, const std::string& class_name) {
    for (size_t at = text.find("@_pass"); at != std::string::npos; at = text.find("@_pass", at))
        text.replace(at, 6, class_name);
    for (size_t at = text.find('@'); at != std::string::npos; at = text.find('@', at))
        text.replace(at, 1, name);
    return text;
}

std::string write_new_pass(const NewPass& request) {
    const std::string& name = request.name;
    if (!is_lower_case_name(name, false)) {
        throw Error("'" + shortened(name) +
                    "' is no name for a pass: it is lower case letters and digits, as 'edges' "
                    "(it also names the group of its resources)");
    }
    // What the program gives these names to already: graph.parameter, scene.lights, material textures, GLSL's own gl_….
    for (const char* reserved : {"graph", "scene", "material", "gl"}) {
        if (name == reserved) throw Error(fmt::format("'{}' is no name for a pass: the program uses it itself", name));
    }
    fs::path shader = glsl_folder() / "user" / (name + ".comp");
    fs::path cpp = root_folder() / "passes" / "surface" / (name + ".cpp");
    fs::path graph_path = find_graph(request.graph);
    GraphFile graph = load_graph_file(graph_path);
    bool taken = std::any_of(graph.nodes.begin(), graph.nodes.end(), [&](auto& node) { return node.id == name; });
    if (taken) throw Error(fmt::format("{} has a pass '{}' already", graph_path.string(), name));
    for (const fs::path& path : {shader, cpp}) {
        if (fs::exists(path) && (request.cpp || path == shader)) throw Error(path.string() + " is there already");
    }

    auto json = nlohmann::ordered_json::parse(read_file(graph_path), nullptr, true, true);
    nlohmann::ordered_json entry;
    entry["id"] = name;
    if (request.cpp) {
        entry["type"] = name;
    } else {
        entry["type"] = "compute";
        entry["shader"] = "user/" + name + ".comp";
        json["resources"][name + ".result"] = {{"format", "rgba16f"}, {"radiance", true}};
    }
    // Before the tone map, where the picture is complete and still linear.
    auto& passes = json["passes"];
    size_t at = passes.size();
    for (size_t i = 0; i < graph.nodes.size(); ++i) {
        if (graph.nodes[i].id == "tonemap") at = i;
    }
    passes.insert(passes.begin() + long(at), entry);

    std::string class_name = name + "Pass";
    class_name[0] = char(std::toupper(class_name[0]));
    fs::create_directories(shader.parent_path());
    write_file_atomically(shader, filled(k_shader, name, class_name));
    std::string done = fmt::format("wrote {}\n", shader.string());
    if (request.cpp) {
        write_file_atomically(cpp, filled(k_cpp, name, class_name));
        done += fmt::format("wrote {}\n", cpp.string());
    }
    write_file_atomically(graph_path, json.dump(2) + "\n");
    done += fmt::format("added '{}' to {}\n", name, graph_path.string());
    done += fmt::format("look at it:  bounce render {} --graph {} --resource {}.result -o {}.png{}\n", "cornell",
                        graph.name, name, name, request.cpp ? "   (after building)" : "");
    return done;
}

} // namespace bounce
