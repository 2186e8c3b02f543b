#include "core/error.h"
#include "core/image.h"
#include "scene/gltf_file.h"
#include "scene/gltf_parts.h"

#include <atomic>
#include <fmt/format.h>
#include <thread>

namespace bounce {

namespace {

Wrap to_wrap(int mode) {
    switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return Wrap::clamp_to_edge;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return Wrap::mirrored_repeat;
    default:
        return Wrap::repeat;
    }
}

/// Runs body(i) for i in [0, count) on all cores; `body` must not throw.
template <class Body>
void in_parallel(size_t count, const Body& body) {
    std::atomic<size_t> next{0};
    auto work = [&] {
        for (size_t i; (i = next++) < count;)
            body(i);
    };
    std::vector<std::jthread> threads;
    for (size_t t = 1; t < std::min<size_t>(count, std::max(1u, std::thread::hardware_concurrency())); ++t)
        threads.emplace_back(work);
    work();
}

} // namespace

std::string TextureTable::image_name(int image) const {
    const tinygltf::Image& from = source_.images[size_t(image)];
    bool external = !from.uri.empty() && !is_data_uri(from.uri);
    const std::string& name = external ? from.uri : from.name;
    return name.empty() ? fmt::format("images[{}]", image) : fmt::format("images[{}] '{}'", image, name.substr(0, 120));
}

int TextureTable::use(int texture, bool srgb) {
    if (texture < 0) return -1;
    const tinygltf::Texture& from = source_.model.textures[size_t(texture)];
    if (from.source < 0) {
        noted_.resize(source_.model.textures.size(), false);
        if (!noted_[size_t(texture)])
            scene_.notes.push_back(
                fmt::format("textures[{}] has no image of a known format and reads as white", texture));
        noted_[size_t(texture)] = true;
        return -1;
    }
    static const tinygltf::Sampler default_sampler;
    const tinygltf::Sampler& sampler =
        from.sampler < 0 ? default_sampler : source_.model.samplers[size_t(from.sampler)];
    Key key{from.source, to_wrap(sampler.wrapS), to_wrap(sampler.wrapT),
            sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST, srgb};
    auto [it, added] = made_.try_emplace(key, int(scene_.textures.size()));
    if (added) {
        Texture& made = scene_.textures.emplace_back();
        const tinygltf::Image& image = source_.images[size_t(from.source)];
        made.name = !from.name.empty()                              ? from.name
                    : !image.name.empty()                           ? image.name
                    : !image.uri.empty() && !is_data_uri(image.uri) ? image.uri
                                                                    : fmt::format("image {}", from.source);
        made.wrap_u = key.wrap_u;
        made.wrap_v = key.wrap_v;
        made.nearest = key.nearest;
        made.srgb = srgb;
        images_.push_back(from.source);
    }
    return it->second;
}

void TextureTable::check_file(int image) const {
    const tinygltf::Image& from = source_.images[size_t(image)];
    if (from.uri.empty() || is_data_uri(from.uri)) return;
    std::string what = source_.where() + ": " + image_name(image);
    std::error_code ignored;
    std::filesystem::path path = uri_path(from.uri, source_.path.parent_path(), what);
    if (!std::filesystem::is_regular_file(path, ignored))
        throw Error(what + ": there is no file '" + path.string() + "'");
}

Image8 TextureTable::decode_image(int image) const {
    const tinygltf::Image& from = source_.images[size_t(image)];
    std::string what = image_name(image);
    if (!from.uri.empty()) {
        std::vector<unsigned char> bytes = read_uri(from.uri, source_.path.parent_path(), what);
        return decode_image8(bytes.data(), bytes.size(), what);
    }
    if (from.bufferView < 0) throw Error(what + " has neither a uri nor a bufferView");
    const tinygltf::BufferView& view = source_.model.bufferViews[size_t(from.bufferView)];
    const auto& buffer = source_.model.buffers[size_t(view.buffer)].data;
    return decode_image8(buffer.data() + view.byteOffset, view.byteLength, what);
}

void TextureTable::drop(int texture) {
    for (Material& material : scene_.materials)
        for (TextureSlot* slot : {&material.base_colour_texture, &material.metallic_roughness_texture,
                                  &material.normal_texture, &material.emission_texture})
            if (slot->texture == texture)
                slot->texture = -1;
            else if (slot->texture > texture)
                --slot->texture;
    scene_.textures.erase(scene_.textures.begin() + texture);
    images_.erase(images_.begin() + texture);
}

void TextureTable::decode() {
    ErrorList missing;
    for (size_t i = 0; i < images_.size(); ++i) {
        try {
            check_file(images_[i]);
        } catch (const Error& error) {
            missing.add(error.what());
        }
    }
    if (missing.messages().size() == 1) throw Error(missing.messages().front());
    missing.throw_if_any(source_.where());

    // An image used in both colour spaces, or with two samplers, is decoded once.
    std::vector<size_t> first;
    std::map<int, size_t> first_of;
    for (size_t i = 0; i < images_.size(); ++i)
        if (first_of.try_emplace(images_[i], i).second) first.push_back(i);
    std::vector<std::string> problems(images_.size());
    in_parallel(first.size(), [&](size_t i) {
        try {
            scene_.textures[first[i]].image = decode_image(images_[first[i]]);
        } catch (const std::exception& error) {
            problems[first[i]] = error.what();
        }
    });
    for (size_t i = 0; i < images_.size(); ++i)
        if (size_t from = first_of[images_[i]]; from != i) scene_.textures[i].image = scene_.textures[from].image;

    for (size_t i : first)
        if (!problems[i].empty()) scene_.notes.push_back("picture reads as white: " + problems[i]);
    for (int i = int(images_.size()) - 1; i >= 0; --i)
        if (scene_.textures[size_t(i)].image.rgba.empty()) drop(i);
}

} // namespace bounce
