#include "scene/gltf_schema.h"

#include "core/json_text.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace bounce {

using nlohmann::json;

namespace {

enum class Kind { boolean, text, whole, number, numbers, index, indices, index_map, object, objects };

struct Field {
    const char* key;
    Kind kind;
    bool required = false;
    const char* target = nullptr;   ///< index…: the collection it points into
    size_t length = 0;              ///< numbers: how many
    std::vector<Field> fields = {}; ///< object, objects
};
using Fields = std::vector<Field>;

constexpr bool k_required = true;

Field boolean(const char* key) {
    return {key, Kind::boolean};
}
Field text(const char* key, bool required = false) {
    return {key, Kind::text, required};
}
Field whole(const char* key, bool required = false) {
    return {key, Kind::whole, required};
}
Field number(const char* key, bool required = false) {
    return {key, Kind::number, required};
}
Field numbers(const char* key, size_t length) {
    return {key, Kind::numbers, false, nullptr, length};
}
Field index(const char* key, const char* target, bool required = false) {
    return {key, Kind::index, required, target};
}
Field indices(const char* key, const char* target) {
    return {key, Kind::indices, false, target};
}
Field object(const char* key, Fields fields, bool required = false) {
    return {key, Kind::object, required, nullptr, 0, std::move(fields)};
}
Field objects(const char* key, Fields fields, bool required = false) {
    return {key, Kind::objects, required, nullptr, 0, std::move(fields)};
}

Field texture_info(const char* key, const char* extra = nullptr) {
    Fields fields{index("index", "textures", k_required), whole("texCoord"),
                  object("extensions", {object("KHR_texture_transform", {numbers("offset", 2), number("rotation"),
                                                                         numbers("scale", 2), whole("texCoord")})})};
    if (extra) fields.push_back(number(extra));
    return object(key, std::move(fields));
}

const Fields& gltf_fields() {
    static const Fields fields{
        object("asset", {text("version", k_required), text("minVersion")}, k_required),
        index("scene", "scenes"),
        objects("scenes", {text("name"), indices("nodes", "nodes")}),
        objects("nodes",
                {text("name"), indices("children", "nodes"), index("camera", "cameras"), index("mesh", "meshes"),
                 numbers("matrix", 16), numbers("rotation", 4), numbers("scale", 3), numbers("translation", 3),
                 object("extensions", {object("KHR_lights_punctual", {index("light", "lights", k_required)})})}),
        objects("meshes", {text("name"), objects("primitives",
                                                 {{"attributes", Kind::index_map, k_required, "accessors"},
                                                  index("indices", "accessors"),
                                                  index("material", "materials"),
                                                  whole("mode")},
                                                 k_required)}),
        objects(
            "accessors",
            {text("name"), index("bufferView", "bufferViews"), whole("byteOffset"), whole("componentType", k_required),
             whole("count", k_required), text("type", k_required), boolean("normalized"),
             object("sparse", {whole("count", k_required),
                               object("indices",
                                      {index("bufferView", "bufferViews", k_required), whole("byteOffset"),
                                       whole("componentType", k_required)},
                                      k_required),
                               object("values", {index("bufferView", "bufferViews", k_required), whole("byteOffset")},
                                      k_required)})}),
        objects("bufferViews", {text("name"), index("buffer", "buffers", k_required), whole("byteOffset"),
                                whole("byteLength", k_required), whole("byteStride")}),
        objects("buffers", {text("name"), text("uri"), whole("byteLength", k_required)}),
        objects("images", {text("name"), text("uri"), index("bufferView", "bufferViews"), text("mimeType")}),
        objects("samplers", {whole("magFilter"), whole("minFilter"), whole("wrapS"), whole("wrapT")}),
        objects("textures", {text("name"), index("sampler", "samplers"), index("source", "images")}),
        objects("materials",
                {text("name"),
                 object("pbrMetallicRoughness",
                        {numbers("baseColorFactor", 4), texture_info("baseColorTexture"), number("metallicFactor"),
                         number("roughnessFactor"), texture_info("metallicRoughnessTexture")}),
                 texture_info("normalTexture", "scale"), texture_info("occlusionTexture", "strength"),
                 texture_info("emissiveTexture"), numbers("emissiveFactor", 3), text("alphaMode"),
                 number("alphaCutoff"), boolean("doubleSided"),
                 object("extensions", {object("KHR_materials_emissive_strength", {number("emissiveStrength")})})}),
        objects("cameras", {text("name"), text("type", k_required),
                            object("perspective", {number("yfov", k_required), number("znear", k_required),
                                                   number("zfar"), number("aspectRatio")}),
                            object("orthographic", {number("xmag", k_required), number("ymag", k_required),
                                                    number("zfar", k_required), number("znear", k_required)})}),
        objects("animations",
                {text("name"),
                 objects("channels",
                         {whole("sampler", k_required),
                          object("target", {index("node", "nodes"), text("path", k_required)}, k_required)},
                         k_required),
                 objects("samplers",
                         {index("input", "accessors", k_required), text("interpolation"),
                          index("output", "accessors", k_required)},
                         k_required)}),
        object("extensions",
               {object("KHR_lights_punctual",
                       {objects("lights",
                                {text("name"), numbers("color", 3), number("intensity"), text("type", k_required),
                                 number("range"), object("spot", {number("innerConeAngle"), number("outerConeAngle")})},
                                k_required)})}),
    };
    return fields;
}

class ShapeCheck {
  public:
    ShapeCheck(const json& root, ErrorList& errors) : errors_(errors) {
        for (const auto& [key, value] : root.items())
            if (value.is_array()) sizes_[key] = value.size();
        auto lights = json::json_pointer("/extensions/KHR_lights_punctual/lights");
        try {
            if (root.contains(lights) && root.at(lights).is_array()) sizes_["lights"] = root.at(lights).size();
        } catch (const json::exception&) {
            // "extensions" is not an object: said by the check itself.
        }
    }

    void check_fields(json& value, const Fields& fields, const std::string& where) {
        if (!value.is_object()) return fail(where, "an object", value);
        for (auto it = value.begin(); it != value.end();) {
            auto known = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return it.key() == f.key; });
            it = known == fields.end() ? value.erase(it) : std::next(it);
        }
        for (const Field& field : fields) {
            std::string at = where.empty() ? field.key : where + "." + field.key;
            auto it = value.find(field.key);
            if (it != value.end()) {
                check(*it, field, at);
            } else if (field.required) {
                errors_.add(at + " is missing");
            }
        }
    }

  private:
    void fail(const std::string& where, const std::string& wanted, const json& value) {
        errors_.add(
            fmt::format("{} must be {}, but is {}", where.empty() ? "the document" : where, wanted, json_kind(value)));
    }

    // Floats are what everything is kept in, so a number must fit one.
    static bool is_real(const json& value) {
        return value.is_number() && std::abs(value.get<double>()) <= double(std::numeric_limits<float>::max());
    }

    bool make_whole(json& value) {
        if (value.is_number_unsigned()) return true;
        if (!value.is_number_float()) return false;
        double real = value.get<double>();
        if (!(real >= 0 && real < 9e15 && real == std::floor(real))) return false;
        value = uint64_t(real);
        return true;
    }

    void check_index(json& value, const Field& field, const std::string& where) {
        if (!make_whole(value)) return fail(where, "an index", value);
        auto size = sizes_.find(field.target);
        size_t count = size == sizes_.end() ? 0 : size->second;
        if (value.get<uint64_t>() >= count)
            errors_.add(fmt::format("{} is {}, but there {} {} of {}", where, value.get<uint64_t>(),
                                    count == 1 ? "is" : "are", count, field.target));
    }

    void check(json& value, const Field& field, const std::string& where) {
        switch (field.kind) {
        case Kind::boolean:
            if (!value.is_boolean()) fail(where, "true or false", value);
            break;
        case Kind::text:
            if (!value.is_string()) fail(where, "text", value);
            break;
        case Kind::whole:
            if (!make_whole(value)) fail(where, "a whole number of 0 or more", value);
            break;
        case Kind::number:
            if (!is_real(value)) fail(where, "a number", value);
            break;
        case Kind::numbers:
            if (!value.is_array() || value.size() != field.length || !std::all_of(value.begin(), value.end(), is_real))
                fail(where, fmt::format("an array of {} numbers", field.length), value);
            break;
        case Kind::index:
            check_index(value, field, where);
            break;
        case Kind::indices:
            if (!value.is_array()) return fail(where, "an array of indices", value);
            for (size_t i = 0; i < value.size(); ++i)
                check_index(value[i], field, fmt::format("{}[{}]", where, i));
            break;
        case Kind::index_map:
            if (!value.is_object()) return fail(where, "an object of indices", value);
            for (auto& [key, item] : value.items())
                check_index(item, field, where + "." + key);
            break;
        case Kind::object:
            check_fields(value, field.fields, where);
            break;
        case Kind::objects:
            if (!value.is_array()) return fail(where, "an array of objects", value);
            for (size_t i = 0; i < value.size(); ++i)
                check_fields(value[i], field.fields, fmt::format("{}[{}]", where, i));
            break;
        }
    }

    ErrorList& errors_;
    std::map<std::string, size_t> sizes_;
};

} // namespace

void check_gltf_shape(json& root, ErrorList& errors) {
    ShapeCheck(root, errors).check_fields(root, gltf_fields(), "");
}

void check_gltf_graph(const json& root, ErrorList& errors) {
    const json none = json::array();
    const json& nodes = root.contains("nodes") ? root["nodes"] : none;
    std::vector<int> parent(nodes.size(), -1);
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (!nodes[i].contains("children")) continue;
        for (const json& item : nodes[i]["children"]) {
            size_t child = item.get<size_t>();
            if (parent[child] >= 0) {
                errors.add(fmt::format("nodes[{}] is a child of nodes[{}] and of nodes[{}]; it may have one parent",
                                       child, parent[child], i));
            } else {
                parent[child] = int(i);
            }
        }
    }
    // With at most one parent each, a node that never reaches a root by going up is on (or below) a cycle.
    enum State : char { unknown, on_path, rooted };
    std::vector<State> state(nodes.size(), unknown);
    for (size_t i = 0; i < nodes.size(); ++i) {
        std::vector<size_t> path;
        int at = int(i);
        while (at >= 0 && state[at] == unknown) {
            state[at] = on_path;
            path.push_back(size_t(at));
            at = parent[at];
        }
        if (at >= 0 && state[at] == on_path) errors.add(fmt::format("nodes[{}] is its own ancestor (a cycle)", at));
        for (size_t visited : path)
            state[visited] = rooted;
    }
    if (!root.contains("scenes")) return;
    for (size_t s = 0; s < root["scenes"].size(); ++s) {
        const json& scene = root["scenes"][s];
        if (!scene.contains("nodes")) continue;
        for (const json& item : scene["nodes"])
            if (int up = parent[item.get<size_t>()]; up >= 0)
                errors.add(fmt::format("scenes[{}] lists nodes[{}], which is not a root: it is a child of nodes[{}]", s,
                                       item.get<size_t>(), up));
    }
}

} // namespace bounce
