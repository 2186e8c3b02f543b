#include "app/new_pass.h"

#include "core/error.h"
#include "core/image.h"
#include "core/json_edit.h"
#include "core/paths.h"
#include "core/scanner.h"
#include "graph/graph_file.h"
#include "graph/graph_overlay.h"
#include "graph/pass.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

namespace fs = std::filesystem;

// The placeholder @ is the pass's name.
static const char* const k_shader = R"(// What this pass computes, in one sentence.
layout(local_size_x = 8, local_size_y = 8) in;

// The picture, linear, before the tone map.
layout(FORMAT_out_radiance) uniform image2D out_radiance; //! ordered: each invocation reads and writes its own pixel

uniform float strength = 1.0;               //! [0, 2] how much of the tint is applied
uniform vec3 tint = vec3(1.0, 0.8, 0.6);    //! what the picture is multiplied by

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(out_radiance)))) return;
    vec3 radiance = imageLoad(out_radiance, pixel).rgb;
    imageStore(out_radiance, pixel, vec4(radiance * mix(vec3(1.0), tint, strength), 1.0));
}
)";

static const char* const k_cpp = R"(// What this pass computes, in one sentence.
#include "graph/context.h"

namespace bounce {

class @_pass : public Pass {
  public:
    void describe(PassDescription& description) override { description.program("main", {"user/@.comp"}); }
    void declare(Declaration& d) override { d.uses("main"); }
    void execute(PassContext& c) override { c.dispatch("main", c.size("out.radiance")); }
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

/// "depth_of_field" → "DepthOfFieldPass".
static std::string class_name_of(const std::string& name) {
    std::string out;
    bool upper = true;
    for (char c : name) {
        if (c != '_') out += upper ? char(std::toupper(static_cast<unsigned char>(c))) : c;
        upper = c == '_';
    }
    return out + "Pass";
}

static void check_name(const NewPass& request) {
    const std::string& name = request.name;
    if (!is_lower_case_name(name, true) || name.find("__") != std::string::npos || name.ends_with('_')) {
        throw Error("invalid pass name '" + shortened(name) +
                    "': expected lower case letters, digits and single underscores, as 'edge_glow'");
    }
    // What the program gives these names to already: graph.parameter, scene.lights, material textures, GLSL's own gl_….
    for (const char* reserved : {"graph", "scene", "material", "gl"}) {
        if (name == reserved)
            throw Error(
                fmt::format("invalid pass name '{}': expected another, because the program uses it itself", name));
    }
    bool known = std::any_of(pass_types().begin(), pass_types().end(), [&](auto& type) { return type.name == name; });
    if (request.cpp && known) throw Error("invalid pass name '" + name + "': there is a pass type of that name");
}

std::string write_new_pass(const NewPass& request) {
    const std::string& name = request.name;
    check_name(request);
    fs::path shader = glsl_folder() / "user" / (name + ".comp");
    fs::path cpp = root_folder() / "passes" / "user" / (name + ".cpp");
    fs::path graph_path = find_graph(request.graph);
    GraphFile graph = read_graph_file(graph_path);
    auto place = std::find_if(graph.nodes.begin(), graph.nodes.end(), [](auto& node) { return node.id == "tonemap"; });
    bool taken = std::any_of(graph.nodes.begin(), graph.nodes.end(), [&](auto& node) { return node.id == name; });
    if (taken) throw Error(fmt::format("{} has a pass '{}' already", graph_path.string(), name));
    for (const fs::path& path : {shader, cpp}) {
        if (fs::exists(path) && (request.cpp || path == shader)) throw Error(path.string() + " is there already");
    }

    // Before the tone map, where the picture is complete and still linear.
    bool extends = graph.files.size() > 1;
    OrderedJson entry = OrderedJson::object();
    if (extends && place != graph.nodes.end()) entry["before"] = "tonemap";
    entry["id"] = name;
    entry["type"] = request.cpp ? name : "compute";
    if (!request.cpp) entry["shader"] = "user/" + name + ".comp";
    JsonEdit text(read_file(graph_path));
    size_t own = parse_graph_text(graph_path).value("passes", OrderedJson::array()).size();
    text.insert({"passes"}, extends ? own : size_t(place - graph.nodes.begin()), on_one_line(entry));

    fs::create_directories(shader.parent_path());
    write_file_atomically(shader, filled(k_shader, name, class_name_of(name)));
    std::string done = fmt::format("wrote {}\n", shader.string());
    if (request.cpp) {
        fs::create_directories(cpp.parent_path());
        write_file_atomically(cpp, filled(k_cpp, name, class_name_of(name)));
        done += fmt::format("wrote {}\n", cpp.string());
    }
    write_file_atomically(graph_path, text.text());
    done += fmt::format("added '{}' to {}\n", name, graph_path.string());
    done += fmt::format("look at it:  bounce render cornell --graph {} -o {}.png{}\n", request.graph, name,
                        request.cpp ? "   (after building)" : "");
    return done;
}

} // namespace bounce
