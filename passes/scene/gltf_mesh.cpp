#include "core/error.h"
#include "core/limits.h"
#include "core/memory.h"
#include "scene/gltf_accessor.h"
#include "scene/gltf_parts.h"
#include "scene/shading_frame.h"
#include "scene/triangle_list.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/packing.hpp>
#include <set>

namespace bounce {

namespace {

bool finite(const glm::vec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

class MeshReader {
  public:
    MeshReader(const GltfSource& source, Scene& scene) : source_(source), scene_(scene) {}

    void read_all() {
        bound_vertices();
        check_totals();
        for (size_t m = 0; m < source_.model.meshes.size(); ++m) {
            const tinygltf::Mesh& from = source_.model.meshes[m];
            Mesh mesh;
            mesh.name = from.name.empty() ? fmt::format("mesh {}", m) : from.name;
            for (size_t p = 0; p < from.primitives.size(); ++p)
                read(from.primitives[p], fmt::format("meshes[{}].primitives[{}]", m, p), mesh);
            scene_.meshes.push_back(std::move(mesh));
        }
        note(lines_, "of points or lines", "left out");
        note(without_positions_, "without POSITION", "left out");
        note(incomplete_, "whose last indices make no whole triangle", "cut short");
        if (bad_normals_)
            scene_.notes.push_back(fmt::format("{} normals of length zero or not finite were replaced", bad_normals_));
        if (bad_tangents_)
            scene_.notes.push_back(fmt::format(
                "{} tangents of length zero, not finite or without handedness were replaced", bad_tangents_));
    }

  private:
    using Attributes = std::map<std::string, int>;
    static constexpr int k_any_indices = -2; ///< beside −1, which is none

    /// A file may name the same bytes in many accessors: what it unfolds to is bounded by how many there are.
    void bound_vertices() {
        size_t bytes = 0;
        for (const tinygltf::Buffer& buffer : source_.model.buffers)
            bytes += buffer.data.size();
        max_vertices_ = std::min(k_max_vertices, k_max_free_vertices + k_max_vertices_per_byte * bytes);
    }

    /// What all primitives unfold to, from their counts: before anything is made.
    void check_totals() const {
        std::set<std::pair<Attributes, int>> counted;
        size_t vertices = 0, indices = 0;
        bool flat = false;
        for (const tinygltf::Mesh& mesh : source_.model.meshes)
            for (const tinygltf::Primitive& from : mesh.primitives) {
                if (from.mode >= 0 && from.mode < TINYGLTF_MODE_TRIANGLES) continue;
                auto position = from.attributes.find("POSITION");
                Attributes attributes(from.attributes.begin(), from.attributes.end());
                if (position == from.attributes.end() || !counted.insert({attributes, from.indices}).second) continue;
                const size_t own = source_.model.accessors[size_t(position->second)].count;
                const size_t used = from.indices < 0 ? own : source_.model.accessors[size_t(from.indices)].count;
                const bool shared = attributes.contains("NORMAL"); // flat corners are vertices of their own
                flat = flat || !shared;
                if (!shared || counted.insert({attributes, k_any_indices}).second) vertices += shared ? own : used;
                indices += used;
            }
        if (vertices > k_max_vertices)
            throw Error(fmt::format("{}: {} triangles unfold to {} vertices; expected at most {} in all: use a smaller "
                                    "scene{}",
                                    source_.where(), grouped(indices / 3), grouped(vertices), grouped(k_max_vertices),
                                    flat ? ", or give its meshes normals (without them each corner is a vertex)" : ""));
        // The scene's vectors grow by doubling, and a primitive's are there beside them.
        const double bytes = 3 * double(vertices) * sizeof(Vertex) + 3 * double(indices) * sizeof(uint32_t);
        if (bytes < double(uint64_t(1) << 28)) return; // asking costs more
        require_memory(bytes, fmt::format("{}: a scene of {} triangles", source_.where(), grouped(indices / 3)),
                       "use a smaller scene, or a machine with more memory");
    }

    void note(size_t count, const char* which, const char* what) {
        if (count)
            scene_.notes.push_back(fmt::format("{} primitive{} {} {} {}", count, count == 1 ? "" : "s", which,
                                               count == 1 ? "is" : "are", what));
    }

    [[noreturn]] void fail(const std::string& message) const { throw Error(source_.where() + ": " + message); }

    std::vector<glm::vec4> attribute(const Attributes& attributes, const std::string& name, const std::string& at,
                                     size_t count, int fewest, int most) const {
        auto it = attributes.find(name);
        if (it == attributes.end()) return {};
        const tinygltf::Accessor& accessor = source_.model.accessors[size_t(it->second)];
        int components = component_count(accessor);
        if (components < fewest || components > most)
            fail(fmt::format("{}.{} (accessors[{}]) must have {} components", at, name, it->second,
                             fewest == most ? fmt::to_string(fewest) : fmt::format("{} or {}", fewest, most)));
        if (accessor.count != count)
            fail(fmt::format("{}.{} has {} elements, but POSITION has {}", at, name, accessor.count, count));
        bool colour = name == "COLOR_0";
        std::vector<glm::vec4> values = read_vectors(source_, it->second, colour);
        if (colour && components == 3)
            for (glm::vec4& value : values)
                value.a = 1;
        return values;
    }

    /// The last one read is kept, for files whose primitives share one vertex buffer.
    const std::vector<Vertex>& read_vertices(const Attributes& attributes, const std::string& at) {
        if (attributes == read_attributes_) return read_vertices_;
        size_t count = source_.model.accessors[size_t(attributes.at("POSITION"))].count;
        spend(count, at);
        std::vector<Vertex> vertices(count);
        for (Vertex& v : vertices)
            v.tangent = glm::vec4(0); // none yet
        auto each = [&](const char* name, int fewest, int most, auto&& set) {
            std::vector<glm::vec4> values = attribute(attributes, name, at, count, fewest, most);
            for (size_t i = 0; i < values.size(); ++i)
                set(vertices[i], values[i], i);
        };
        each("POSITION", 3, 3, [&](Vertex& v, const glm::vec4& value, size_t i) {
            if (!finite(value)) fail(fmt::format("{}.POSITION: element {} is not finite", at, i));
            v.position = value;
        });
        each("NORMAL", 3, 3, [](Vertex& v, const glm::vec4& value, size_t) { v.normal = value; });
        each("TANGENT", 4, 4, [](Vertex& v, const glm::vec4& value, size_t) {
            // What is missing of direction or handedness is made later (make_tangents).
            bool usable = usable_normal(glm::vec3(value)), handed = value.w == 1 || value.w == -1;
            glm::vec3 direction = usable ? glm::vec3(glm::normalize(glm::dvec3(value))) : glm::vec3(0);
            v.tangent = glm::vec4(direction, handed ? value.w : 0.0f);
        });
        each("TEXCOORD_0", 2, 2, [](Vertex& v, const glm::vec4& value, size_t) {
            if (finite(value)) v.u0 = value.x, v.v0 = value.y;
        });
        each("TEXCOORD_1", 2, 2, [](Vertex& v, const glm::vec4& value, size_t) {
            if (finite(value)) v.u1 = value.x, v.v1 = value.y;
        });
        each("COLOR_0", 3, 4, [](Vertex& v, const glm::vec4& value, size_t) {
            if (!finite(value)) return;
            v.colour_rg = glm::packUnorm2x16({value.r, value.g});
            v.colour_ba = glm::packUnorm2x16({value.b, value.a});
        });
        read_attributes_ = attributes;
        read_vertices_ = std::move(vertices);
        return read_vertices_;
    }

    std::vector<uint32_t> read_triangles(const tinygltf::Primitive& from, int mode, size_t vertex_count,
                                         const std::string& at) {
        std::vector<uint32_t> indices;
        spend(from.indices >= 0 ? source_.model.accessors[size_t(from.indices)].count : vertex_count, at);
        if (from.indices >= 0) {
            indices = read_indices(source_, from.indices, source_.where() + ": " + at + ".indices");
        } else {
            indices.resize(vertex_count);
            for (size_t i = 0; i < vertex_count; ++i)
                indices[i] = uint32_t(i);
        }
        for (size_t i = 0; i < indices.size(); ++i)
            if (indices[i] >= vertex_count)
                fail(fmt::format("{}.indices: index {} is {}, but there are {} vertices", at, i, indices[i],
                                 vertex_count));
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) return triangles_of_strip(indices);
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN) return triangles_of_fan(indices);
        incomplete_ += indices.size() % 3 != 0;
        indices.resize(indices.size() / 3 * 3);
        return indices;
    }

    int material_of(const tinygltf::Primitive& from) {
        if (from.material >= 0) return from.material;
        if (default_material_ < 0) {
            default_material_ = int(scene_.materials.size());
            scene_.materials.emplace_back().name = "default";
        }
        return default_material_;
    }

    void read(const tinygltf::Primitive& from, const std::string& at, Mesh& mesh) {
        int mode = from.mode < 0 ? TINYGLTF_MODE_TRIANGLES : from.mode;
        if (mode > TINYGLTF_MODE_TRIANGLE_FAN) fail(fmt::format("{}.mode is {}, but must be 0 … 6", at, mode));
        if (mode < TINYGLTF_MODE_TRIANGLES) return void(++lines_);
        if (!from.attributes.contains("POSITION")) return void(++without_positions_);

        int material = material_of(from);
        const TextureSlot& normal_slot = scene_.materials[size_t(material)].normal_texture;
        bool flat = !from.attributes.contains("NORMAL");
        // The specification has tangents ignored where there are no normals.
        Defects defects = defects_of(from.attributes, at);
        bool wants_tangents = normal_slot.texture >= 0 && (flat || defects.tangents);

        Key key{{from.attributes.begin(), from.attributes.end()}, from.indices, mode, wants_tangents ? material : -1};
        auto [known, is_new] = made_.try_emplace(key);
        if (is_new) {
            bool own = flat || defects.normals || wants_tangents;
            known->second = own ? make_own(key, from, normal_slot, at) : make_shared(key, from, at);
        }
        Primitive primitive = known->second;
        primitive.material = material;
        if (primitive.index_count > 0) mesh.primitives.push_back(primitive);
    }

    /// What some of a set of vertices lack. Normals and tangents are then made for each primitive from its own
    /// triangles: primitives may share vertices and nothing else.
    struct Defects {
        bool normals = false;  ///< of length zero or not finite
        bool tangents = false; ///< or no handedness
    };
    Defects defects_of(const Attributes& attributes, const std::string& at) {
        auto [known, is_new] = defects_.try_emplace(attributes);
        if (!is_new) return known->second;
        size_t bad_tangents = 0;
        for (const Vertex& v : read_vertices(attributes, at)) {
            known->second.normals = known->second.normals || !usable_normal(v.normal);
            bad_tangents += !has_tangent(v);
        }
        known->second.tangents = bad_tangents > 0;
        if (attributes.contains("TANGENT")) bad_tangents_ += bad_tangents;
        return known->second;
    }

    struct Key {
        Attributes attributes;
        int indices;
        int mode;
        int tangent_material; ///< whose texture coordinates the tangents follow; -1: none are made
        auto operator<=>(const Key&) const = default;
    };

    /// Vertices that stay as they are in the file are shared by all primitives that name the same accessors.
    Primitive make_shared(const Key& key, const tinygltf::Primitive& from, const std::string& at) {
        size_t count = source_.model.accessors[size_t(key.attributes.at("POSITION"))].count;
        std::vector<uint32_t> indices = read_triangles(from, key.mode, count, at);
        auto [base, is_new] = vertex_base_.try_emplace(key.attributes, scene_.vertices.size());
        if (is_new) {
            check_room(count, indices.size(), at);
            std::vector<Vertex> vertices = read_vertices(key.attributes, at);
            repair_normals(vertices, indices);
            finish_tangents(vertices);
            scene_.vertices.insert(scene_.vertices.end(), vertices.begin(), vertices.end());
        }
        return append_indices(indices, base->second, at);
    }

    /// Vertices that change (normals or tangents made) belong to one primitive, and only those that it uses are
    /// kept.
    Primitive make_own(const Key& key, const tinygltf::Primitive& from, const TextureSlot& normal_slot,
                       const std::string& at) {
        const std::vector<Vertex>& all = read_vertices(key.attributes, at);
        std::vector<uint32_t> indices = read_triangles(from, key.mode, all.size(), at);
        check_room(indices.size(), indices.size(), at);
        std::vector<Vertex> vertices = used_vertices(all, indices);
        if (!key.attributes.contains("NORMAL"))
            make_flat_normals(vertices, indices);
        else
            bad_normals_ += repair_normals(vertices, indices);
        if (key.tangent_material >= 0) make_tangents(vertices, indices, normal_slot);
        finish_tangents(vertices);
        size_t base = scene_.vertices.size();
        scene_.vertices.insert(scene_.vertices.end(), vertices.begin(), vertices.end());
        return append_indices(indices, base, at);
    }

    /// Elements read in all, so that a small file cannot ask for hours of work.
    void spend(size_t elements, const std::string& at) {
        if (elements > k_max_elements_read - work_)
            fail(fmt::format("{}: the file's primitives read more than {} elements in all", at, k_max_elements_read));
        work_ += elements;
    }

    void check_room(size_t vertices, size_t indices, const std::string& at) const {
        if (scene_.vertices.size() + vertices > max_vertices_ || scene_.indices.size() + indices > k_max_indices)
            fail(
                fmt::format("{}: the file unfolds to more than {} vertices or {} indices; expected at most {} vertices "
                            "for each byte of its buffers",
                            at, grouped(max_vertices_), grouped(k_max_indices), k_max_vertices_per_byte));
    }

    Primitive append_indices(const std::vector<uint32_t>& indices, size_t base, const std::string& at) {
        check_room(0, indices.size(), at);
        Primitive out;
        out.first_index = uint32_t(scene_.indices.size());
        out.index_count = uint32_t(indices.size());
        for (uint32_t index : indices)
            scene_.indices.push_back(uint32_t(base + index));
        return out;
    }

    const GltfSource& source_;
    Scene& scene_;
    std::map<Key, Primitive> made_;
    std::map<Attributes, size_t> vertex_base_;
    std::map<Attributes, Defects> defects_;
    Attributes read_attributes_;
    std::vector<Vertex> read_vertices_;
    size_t work_ = 0;
    size_t max_vertices_ = k_max_vertices;
    int default_material_ = -1;
    size_t lines_ = 0, without_positions_ = 0, incomplete_ = 0, bad_normals_ = 0, bad_tangents_ = 0;
};

} // namespace

void read_meshes(const GltfSource& source, Scene& scene) {
    MeshReader(source, scene).read_all();
}

} // namespace bounce
