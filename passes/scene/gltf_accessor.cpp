#include "scene/gltf_accessor.h"

#include "core/error.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <type_traits>

namespace bounce {

namespace {

const unsigned char* view_data(const GltfSource& source, int view, size_t offset) {
    const tinygltf::BufferView& v = source.model.bufferViews[size_t(view)];
    return source.model.buffers[size_t(v.buffer)].data.data() + v.byteOffset + offset;
}

template <class T>
T load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value); // files may be unaligned
    return value;
}

template <class T>
float to_float(T value, bool normalised) {
    if constexpr (std::is_floating_point_v<T>) {
        return value;
    } else {
        if (!normalised) return float(value);
        return std::max(float(double(value) / double(std::numeric_limits<T>::max())), -1.0f);
    }
}

template <class T>
void convert(const unsigned char* bytes, size_t stride, size_t count, int components, bool normalised, glm::vec4* out) {
    for (size_t i = 0; i < count; ++i)
        for (int c = 0; c < components; ++c)
            out[i][c] = to_float(load<T>(bytes + i * stride + size_t(c) * sizeof(T)), normalised);
}

void convert(int component_type, const unsigned char* bytes, size_t stride, size_t count, int components,
             bool normalised, glm::vec4* out) {
    switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return convert<int8_t>(bytes, stride, count, components, normalised, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return convert<uint8_t>(bytes, stride, count, components, normalised, out);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return convert<int16_t>(bytes, stride, count, components, normalised, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return convert<uint16_t>(bytes, stride, count, components, normalised, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return convert<uint32_t>(bytes, stride, count, components, normalised, out);
    default:
        return convert<float>(bytes, stride, count, components, normalised, out);
    }
}

uint32_t load_index(int component_type, const unsigned char* bytes, size_t i) {
    switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return bytes[i];
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<uint16_t>(bytes + 2 * i);
    default:
        return load<uint32_t>(bytes + 4 * i);
    }
}

size_t stride_of(const GltfSource& source, const tinygltf::Accessor& accessor) {
    size_t stride = source.model.bufferViews[size_t(accessor.bufferView)].byteStride;
    return stride ? stride : gltf_element_bytes(accessor.componentType, accessor.type);
}

/// Calls `replace(index, bytes of the new element)` for every element that a sparse accessor replaces.
template <class Replace>
void for_each_sparse(const GltfSource& source, int index, const Replace& replace) {
    const tinygltf::Accessor& accessor = source.model.accessors[size_t(index)];
    if (!accessor.sparse.isSparse) return;
    const auto& sparse = accessor.sparse;
    const unsigned char* at = view_data(source, sparse.indices.bufferView, size_t(sparse.indices.byteOffset));
    const unsigned char* values = view_data(source, sparse.values.bufferView, size_t(sparse.values.byteOffset));
    size_t element = gltf_element_bytes(accessor.componentType, accessor.type);
    for (size_t i = 0; i < size_t(sparse.count); ++i) {
        size_t target = load_index(sparse.indices.componentType, at, i);
        if (target >= accessor.count)
            throw Error(fmt::format("{}: accessors[{}].sparse replaces element {}, but there are {}", source.where(),
                                    index, target, accessor.count));
        replace(target, values + i * element);
    }
}

} // namespace

int component_count(const tinygltf::Accessor& accessor) {
    switch (accessor.type) {
    case TINYGLTF_TYPE_SCALAR:
        return 1;
    case TINYGLTF_TYPE_VEC2:
        return 2;
    case TINYGLTF_TYPE_VEC3:
        return 3;
    case TINYGLTF_TYPE_VEC4:
        return 4;
    default:
        return 0;
    }
}

std::vector<glm::vec4> read_vectors(const GltfSource& source, int index, bool normalise) {
    const tinygltf::Accessor& accessor = source.model.accessors[size_t(index)];
    int components = component_count(accessor);
    normalise = normalise || accessor.normalized;
    std::vector<glm::vec4> out(accessor.count, glm::vec4(0));
    const unsigned char* bytes = view_data(source, accessor.bufferView, accessor.byteOffset);
    convert(accessor.componentType, bytes, stride_of(source, accessor), accessor.count, components, normalise,
            out.data());
    for_each_sparse(source, index, [&](size_t target, const unsigned char* value) {
        convert(accessor.componentType, value, 0, 1, components, normalise, &out[target]);
    });
    return out;
}

std::vector<uint32_t> read_indices(const GltfSource& source, int index, const std::string& what) {
    const tinygltf::Accessor& accessor = source.model.accessors[size_t(index)];
    bool whole = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                 accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                 accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !whole)
        throw Error(fmt::format("{}: accessors[{}] must be a SCALAR of unsigned bytes, shorts or ints", what, index));
    std::vector<uint32_t> out(accessor.count);
    const unsigned char* bytes = view_data(source, accessor.bufferView, accessor.byteOffset);
    size_t stride = stride_of(source, accessor);
    for (size_t i = 0; i < out.size(); ++i)
        out[i] = load_index(accessor.componentType, bytes + i * stride, 0);
    for_each_sparse(source, index, [&](size_t target, const unsigned char* value) {
        out[target] = load_index(accessor.componentType, value, 0);
    });
    return out;
}

} // namespace bounce
