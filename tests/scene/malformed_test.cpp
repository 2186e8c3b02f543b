// Every file of two validators' own tests, and every built-in scene damaged at random: each loads or is an Error. Run
// under the sanitizers, which see the rest.

#include "gltf_builder.h"
#include "scene/describe.h"

#include <chrono>
#include <random>

namespace bounce::testing {
namespace {

/// Loads and uses whatever can be loaded; true when it loaded.
bool open_and_use(const fs::path& path) {
    try {
        Scene scene = load_gltf(path);
        Shot shot;
        shot.scene = scene;
        EXPECT_FALSE(describe_scene(shot).empty());
        evaluate_scene(scene, 0.5f, 0.25f);
        for (const Mesh& mesh : scene.meshes)
            for (const Primitive& primitive : mesh.primitives)
                for (uint32_t i = 0; i < primitive.index_count; ++i)
                    EXPECT_LT(scene.indices.at(primitive.first_index + i), scene.vertices.size());
        return true;
    } catch (const Error& error) {
        EXPECT_STRNE(error.what(), "");
        return false;
    }
}

TEST(Malformed, EveryFileLoadsOrIsAnError) {
    fs::path root = shared_scene("malformed");
    if (root.empty()) GTEST_SKIP() << "the folder of malformed files is not beside the source tree";
    size_t files = 0, loaded = 0;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        if (!entry.is_regular_file()) continue;
        ++files;
        auto start = std::chrono::steady_clock::now();
        loaded += open_and_use(entry.path());
        std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        EXPECT_LT(seconds.count(), 5.0) << entry.path(); // a hang, not a speed
    }
    EXPECT_GE(files, 271u);
    EXPECT_GT(loaded, 0u);
    RecordProperty("files", int(files));
    RecordProperty("loaded", int(loaded));
}

TEST(Malformed, KnownVerdicts) {
    fs::path root = shared_scene("malformed");
    if (root.empty()) GTEST_SKIP() << "the folder of malformed files is not beside the source tree";
    fs::path khronos = root / "glTF-Validator/test/base/data", tiny = root / "tinygltf/models";
    for (const char* good : {"glb/valid.glb", "mesh/valid.gltf", "node/valid.gltf", "material/alpha_modes.gltf",
                             "animation/valid.gltf", "glb/bom.glb"}) {
        if (!fs::exists(khronos / good)) continue;
        std::string what;
        try {
            load_gltf(khronos / good);
        } catch (const Error& error) {
            what = error.what();
        }
        bool by_design = std::string(good).find("bom") != std::string::npos; // a byte order mark may go either way
        EXPECT_TRUE(what.empty() || by_design) << good << ": " << what;
    }
    for (const char* bad : {"node/node_loop.gltf", "node/node_parent_override.gltf", "node/unresolved_mesh.gltf",
                            "glb/truncated_chunk_data.glb", "glb/chunk_too_big.glb", "glb/only_header.glb",
                            "json/empty_file.gltf", "mesh/unresolved_positions.gltf"})
        EXPECT_THROW(load_gltf(khronos / bad), Error) << bad;
    for (const char* bad :
         {"BoundsChecking/invalid-buffer-index.gltf", "BoundsChecking/invalid-buffer-view-index.gltf",
          "BoundsChecking/invalid-primitive-indices.gltf", "BoundsChecking/integer-out-of-bounds.gltf"})
        EXPECT_THROW(load_gltf(tiny / bad), Error) << bad;
}

/// A small file that uses nearly everything, as a .glb.
std::string rich_glb() {
    GltfBuilder b;
    int sparse = b.vec3s({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    b.root["accessors"][size_t(sparse)]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", b.view(bytes_of<uint16_t>({2}))}, {"componentType", 5123}}},
        {"values", {{"bufferView", b.view(bytes_of<float>({5, 6, 7}))}}}};
    b.add("images", {{"bufferView", b.view("not a picture")}, {"mimeType", "image/png"}});
    b.add("textures", {{"source", 0}});
    b.add("materials", {{"normalTexture", {{"index", 0}}}, {"alphaMode", "BLEND"}});
    json attributes{{"POSITION", sparse}, {"TEXCOORD_0", b.vec2s({0, 0, 1, 0, 0, 1, 1, 1})}};
    int indices = b.accessor_of<uint16_t>({0, 1, 2, 3}, u16, "SCALAR", 1);
    b.node({{"mesh", b.mesh({{"attributes", attributes}, {"indices", indices}, {"mode", 5}, {"material", 0}})}});
    b.node({{"children", {0}}});
    json sampler{{"input", b.scalars({0, 1})}, {"output", b.vec3s({0, 0, 0, 1, 1, 1})}};
    b.add("animations",
          {{"samplers", {sampler}}, {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "scale"}}}}}}});
    b.root["buffers"] = {{{"byteLength", b.data.size()}}};
    std::string text = b.root.dump();
    while (text.size() % 4)
        text += ' ';
    while (b.data.size() % 4)
        b.data += '\0';
    auto word = [](size_t v) { return bytes_of<uint32_t>({uint32_t(v)}); };
    return "glTF" + word(2) + word(28 + text.size() + b.data.size()) + word(text.size()) + "JSON" + text +
           word(b.data.size()) + std::string("BIN\0", 4) + b.data;
}

TEST(Malformed, RandomDamage) {
    TempFolder folder;
    const std::string whole = rich_glb();
    ASSERT_TRUE(open_and_use(folder.write("whole.glb", whole)));
    std::mt19937 random(1);
    auto below = [&](size_t n) { return size_t(random() % n); };
    for (int round = 0; round < 600; ++round) {
        std::string bytes = whole;
        size_t changes = 1 + below(3);
        for (size_t i = 0; i < changes; ++i) {
            size_t at = below(bytes.size());
            switch (below(4)) {
            case 0:
                bytes[at] = char(random());
                break;
            case 1:
                bytes[at] = "0123456789-.e\"[]{},:"[below(20)];
                break;
            case 2: // a digit becomes another: the numbers lie, the structure stands
                while (!std::isdigit(static_cast<unsigned char>(bytes[at])))
                    at = (at + 1) % bytes.size();
                bytes[at] = char('0' + below(10));
                break;
            default:
                bytes[at] = char(0xff);
                break;
            }
        }
        SCOPED_TRACE(round);
        open_and_use(folder.write("damaged.glb", bytes));
        if (HasFatalFailure()) return;
    }
}

TEST(Malformed, RandomValues) {
    // The structure stands, and one or two of its values are anything at all.
    const std::string whole = rich_glb();
    uint32_t json_size;
    std::memcpy(&json_size, whole.data() + 12, 4);
    json root = json::parse(whole.substr(20, json_size));
    root["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(whole.substr(28 + json_size));
    const json flat = root.flatten();
    std::vector<std::string> keys;
    for (const auto& [key, value] : flat.items()) {
        keys.push_back(key);
        if (auto slash = key.rfind('/'); slash > 0) keys.push_back(key.substr(0, slash)); // and what holds it
    }
    const std::vector<json> anything{0,
                                     1,
                                     -1,
                                     2,
                                     255,
                                     65536,
                                     uint64_t(1) << 31,
                                     1e30,
                                     -1e300,
                                     0.5,
                                     nullptr,
                                     true,
                                     "",
                                     "SCALAR",
                                     "MAT4",
                                     "VEC4",
                                     json(),
                                     5120,
                                     5121,
                                     5125,
                                     ~uint64_t(0),
                                     {1, 2},
                                     {0},
                                     "weights",
                                     "STEP",
                                     "MASK",
                                     "CUBICSPLINE",
                                     json::array(),
                                     {-1, 0},
                                     uint64_t(1) << 62,
                                     json::object()};
    TempFolder folder;
    std::mt19937 random(2);
    for (int round = 0; round < 800; ++round) {
        json damaged = root;
        for (size_t i = 0; i < 1 + random() % 2; ++i) {
            json::json_pointer at(keys[random() % keys.size()]);
            if (damaged.contains(at)) damaged[at] = anything[random() % anything.size()];
        }
        SCOPED_TRACE(damaged.dump());
        open_and_use(folder.write("damaged.gltf", damaged.dump()));
    }
}

} // namespace
} // namespace bounce::testing
