#include "scene/gltf_bounds.h"

#include "core/limits.h"
#include "scene/gltf_source.h"

#include <fmt/format.h>

namespace bounce {

using nlohmann::json;

namespace {

size_t whole(const json& object, const char* key) {
    auto it = object.find(key);
    return it == object.end() ? 0 : it->get<size_t>();
}

struct Range {
    size_t view;
    size_t offset;
    size_t count;
    size_t element;
    bool packed; ///< the view's stride does not apply (sparse parts)
};

class BoundsCheck {
  public:
    BoundsCheck(const json& root, ErrorList& errors)
        : views_(root.value("bufferViews", json::array())), errors_(errors) {}

    void views(const std::vector<size_t>& buffer_sizes) {
        for (size_t i = 0; i < views_.size(); ++i) {
            size_t buffer = whole(views_[i], "buffer");
            size_t offset = whole(views_[i], "byteOffset"), length = whole(views_[i], "byteLength");
            size_t size = buffer_sizes[buffer];
            if (size_t stride = whole(views_[i], "byteStride"); stride % 4 != 0 || stride > 252)
                errors_.add(fmt::format("bufferViews[{}].byteStride {} is no multiple of 4 up to 252", i, stride));
            if (offset > size || length > size - offset)
                errors_.add(fmt::format("bufferViews[{}] reaches outside its buffer: {} bytes from byte {}, but "
                                        "buffers[{}] has {}",
                                        i, length, offset, buffer, size));
        }
    }

    void accessor(const json& accessor, const std::string& where) {
        int component = int(whole(accessor, "componentType"));
        const std::string& type_name = accessor["type"].get_ref<const std::string&>();
        size_t element = gltf_element_bytes(component, gltf_type(type_name));
        if (gltf_type(type_name) < 0)
            return errors_.add(where + ".type '" + type_name.substr(0, 40) +
                               "' is none of SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3, MAT4");
        if (element == 0)
            return errors_.add(fmt::format("{}.componentType {} is none of 5120 … 5123, 5125, 5126", where, component));
        size_t count = whole(accessor, "count");
        if (count == 0) return errors_.add(where + ".count is 0; an accessor has at least one element");

        if (accessor.contains("bufferView")) {
            range({whole(accessor, "bufferView"), whole(accessor, "byteOffset"), count, element, false}, where);
        } else if (count > k_max_zero_elements) {
            errors_.add(fmt::format("{} has no bufferView and says {} elements; more than {} zeros are refused", where,
                                    count, k_max_zero_elements));
        }
        if (accessor.contains("sparse")) sparse(accessor["sparse"], count, element, where + ".sparse");
    }

  private:
    void sparse(const json& sparse, size_t accessor_count, size_t element, const std::string& where) {
        size_t count = whole(sparse, "count");
        if (count == 0 || count > accessor_count)
            return errors_.add(fmt::format("{}.count is {}, but must be 1 … {}", where, count, accessor_count));
        const json& indices = sparse["indices"];
        int component = int(whole(indices, "componentType"));
        if (component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
            component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
            return errors_.add(
                fmt::format("{}.indices.componentType {} is none of 5121, 5123, 5125", where, component));
        size_t index_bytes = gltf_element_bytes(component, TINYGLTF_TYPE_SCALAR);
        range({whole(indices, "bufferView"), whole(indices, "byteOffset"), count, index_bytes, true},
              where + ".indices");
        const json& values = sparse["values"];
        range({whole(values, "bufferView"), whole(values, "byteOffset"), count, element, true}, where + ".values");
    }

    void range(const Range& r, const std::string& where) {
        const json& view = views_[r.view];
        size_t length = whole(view, "byteLength");
        size_t stride = r.packed ? r.element : whole(view, "byteStride");
        if (stride == 0) stride = r.element;
        if (stride < r.element)
            return errors_.add(fmt::format("{}: bufferViews[{}].byteStride {} is less than the {} bytes of an element",
                                           where, r.view, stride, r.element));
        bool fits = r.offset <= length && r.element <= length - r.offset &&
                    (r.count - 1) <= (length - r.offset - r.element) / stride;
        if (!fits)
            errors_.add(fmt::format("{} reaches outside its view: {} elements of {} bytes, {} apart, from byte {}, but "
                                    "bufferViews[{}] has {} bytes",
                                    where, r.count, r.element, stride, r.offset, r.view, length));
    }

    const json views_;
    ErrorList& errors_;
};

} // namespace

void check_gltf_bounds(const json& root, const std::vector<size_t>& buffer_sizes, ErrorList& errors) {
    BoundsCheck check(root, errors);
    check.views(buffer_sizes);
    if (!root.contains("accessors")) return;
    for (size_t i = 0; i < root["accessors"].size(); ++i)
        check.accessor(root["accessors"][i], fmt::format("accessors[{}]", i));
}

} // namespace bounce
