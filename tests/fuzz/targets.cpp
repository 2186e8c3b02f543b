#include "fuzz/targets.h"

#include "app/experiments/sweep.h"
#include "core/error.h"
#include "core/image.h"
#include "core/json_edit.h"
#include "core/json_text.h"
#include "core/limits.h"
#include "core/log.h"
#include "core/parameters.h"
#include "gpu/shader_limits.h"
#include "gpu/shader_source.h"
#include "graph/expression.h"
#include "graph/model.h"
#include "scene/shot.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <unistd.h>

namespace bounce {

namespace fs = std::filesystem;

namespace {

/// A folder of this process in memory, for inputs that are read from files; removed at the end. It is a root of its
/// own, too: what inputs name is not looked for among the real scenes.
class Workspace {
  public:
    Workspace() {
        std::error_code ignored;
        std::string pattern =
            fs::is_directory("/dev/shm", ignored) ? "/dev/shm/bounce_fuzz_XXXXXX" : "/tmp/bounce_fuzz_XXXXXX";
        if (!::mkdtemp(pattern.data())) throw std::runtime_error("no folder for the inputs can be made");
        folder_ = pattern;
        for (const char* name : {"glsl", "assets/scenes", "assets/shots", "assets/graphs", "assets/sweeps"})
            fs::create_directories(folder_ / name);
        write("triangle.gltf", k_triangle);
        // Small, so that what an input says of its sizes is refused within the fuzzer's memory.
        set_max_texture_pixels(uint64_t(2048) * 2048);
        spdlog::set_level(spdlog::level::off);
    }
    ~Workspace() {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;

    fs::path write(const char* name, std::string_view bytes) const {
        const fs::path path = folder_ / name;
        const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
        if (file < 0 || ::write(file, bytes.data(), bytes.size()) != ssize_t(bytes.size()))
            throw std::runtime_error("an input cannot be written");
        ::close(file);
        return path;
    }
    const fs::path& folder() const { return folder_; }

  private:
    static constexpr const char* k_triangle =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
        R"("buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":36}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3,"min":[0,0,0],"max":[1,1,0]}]})";
    fs::path folder_;
};

const Workspace& workspace() {
    static const Workspace space;
    return space;
}

std::string_view view(const uint8_t* data, size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// An Error is a right answer to bad input; anything else that is thrown is not, and ends the fuzzer.
template <class Action>
void may_refuse(Action&& action) {
    try {
        action();
    } catch (const Error&) {
    }
}

void gltf(const uint8_t* data, size_t size) {
    const fs::path path = workspace().write("input.gltf", view(data, size));
    may_refuse([&] { load_gltf(path); });
}

void image(const uint8_t* data, size_t size) {
    workspace();
    may_refuse([&] { decode_image8(data, size, "input"); });
}

void hdr(const uint8_t* data, size_t size) {
    const fs::path path = workspace().write("input.hdr", view(data, size));
    may_refuse([&] { read_hdr(path); });
}

void exr(const uint8_t* data, size_t size) {
    const fs::path path = workspace().write("input.exr", view(data, size));
    may_refuse([&] { read_exr(path); });
}

void shot(const uint8_t* data, size_t size) {
    ::setenv("BOUNCE_ROOT", workspace().folder().c_str(), 1);
    const fs::path path = workspace().write("input.json", view(data, size));
    may_refuse([&] {
        const Shot loaded = load_shot(path.string());
        evaluate_shot(loaded, 3);
        shot_facts(loaded);
    });
}

void graph(const uint8_t* data, size_t size) {
    const fs::path path = workspace().write("input.json", view(data, size));
    may_refuse([&] {
        GraphModel model(read_graph_file(path));
        model.plan(SceneFacts(), {64, 48});
    });
}

void sweep(const uint8_t* data, size_t size) {
    const fs::path path = workspace().write("input.json", view(data, size));
    may_refuse([&] { load_sweep(path.string()).combinations(); });
}

void parameter_line(const uint8_t* data, size_t size) {
    ParameterInfo info;
    may_refuse([&] {
        if (parse_parameter_line(view(data, size), info)) {
            to_text(info, info.default_value);
            static_literal(info, info.default_value);
        }
    });
}

void shader(const uint8_t* data, size_t size) {
    workspace().write("glsl/common.glsl", "uniform float common_scale = 1.0; //! [0, 2] a help\n");
    workspace().write("glsl/input.comp", view(data, size));
    const ShaderSource source = expand_shader("input.comp", workspace().folder() / "glsl", {}, {});
    check_shader_limits(source, workspace().folder() / "glsl");
    translate_log("0:3(1): error: no\n" + std::string(view(data, size)), source, workspace().folder() / "glsl");
}

/// The edited text must read as what the same edit makes of the document.
void json_edit(const uint8_t* data, size_t size) {
    const std::string text(view(data, size));
    may_refuse([&] {
        nlohmann::json expected = parse_json(text, "input", JsonComments::allowed);
        if (!expected.is_object()) return;
        JsonEdit edit(text);
        if (!expected.empty()) {
            const std::string first = expected.begin().key();
            edit.set({first}, "[7]");
            expected[first] = {7};
        }
        edit.insert({"a list"}, 1, "true");
        nlohmann::json& list = expected["a list"];
        if (list.is_null()) list = nlohmann::json::array();
        list.insert(list.begin() + std::min<std::ptrdiff_t>(1, std::ssize(list)), true);
        edit.set({"an object", "member"}, "{}");
        expected["an object"]["member"] = nlohmann::json::object();
        if (parse_json(edit.text(), "the edited text", JsonComments::allowed) != expected)
            throw std::logic_error("an edit changed something else: " + edit.text());
    });
}

void expression(const uint8_t* data, size_t size) {
    const auto lookup = [](const std::string& name) -> std::optional<double> {
        if (name == "width") return 640.0;
        if (name == "voxel.resolution") return 128.0;
        return std::nullopt;
    };
    may_refuse([&] { evaluate_integer(std::string(view(data, size)), lookup, 0); });
}

} // namespace

const std::vector<FuzzTarget>& fuzz_targets() {
    static const std::vector<FuzzTarget> targets = {
        {"gltf", gltf},
        {"image", image},
        {"hdr", hdr},
        {"exr", exr},
        {"shot", shot},
        {"graph", graph},
        {"sweep", sweep},
        {"shader", shader},
        {"parameter_line", parameter_line},
        {"json_edit", json_edit},
        {"expression", expression},
    };
    return targets;
}

} // namespace bounce
