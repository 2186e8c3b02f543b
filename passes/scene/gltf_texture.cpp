#include "core/error.h"
#include "core/image.h"
#include "core/image_budget.h"
#include "core/limits.h"
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

std::span<const unsigned char> TextureTable::encoded(int image, std::vector<unsigned char>& file) const {
    const tinygltf::Image& from = source_.images[size_t(image)];
    if (!from.uri.empty()) {
        file = read_uri(from.uri, source_.path.parent_path(), image_name(image), k_max_image_bytes);
        return file;
    }
    if (from.bufferView < 0) return {};
    const tinygltf::BufferView& view = source_.model.bufferViews[size_t(from.bufferView)];
    const auto& buffer = source_.model.buffers[size_t(view.buffer)].data;
    return std::span(buffer).subspan(view.byteOffset, view.byteLength);
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
    // An image used in both colour spaces, or with two samplers, is decoded once.
    struct Source {
        int image;
        size_t first; ///< of the textures that show it
        std::vector<unsigned char> file;
        std::span<const unsigned char> bytes;
        DeclaredSize size;
        std::string problem;
    };
    std::vector<Source> sources;
    std::map<int, size_t> source_of;
    ErrorList refused;
    for (size_t i = 0; i < images_.size(); ++i) {
        if (!source_of.try_emplace(images_[i], sources.size()).second) continue;
        Source& source = sources.emplace_back(Source{images_[i], i, {}, {}, {}, {}});
        try {
            source.bytes = encoded(source.image, source.file);
            if (source.bytes.empty()) source.problem = image_name(source.image) + " has neither a uri nor a bufferView";
        } catch (const Error& error) {
            if (is_data_uri(source_.images[size_t(source.image)].uri))
                source.problem = error.what(); // damaged, as a picture may be
            else
                refused.add(error.what());
        }
    }
    refused.throw_if_any(source_.where());

    uint64_t pixels = 0;
    for (int image : images_) {
        Source& source = sources[source_of[image]];
        if (source.problem.empty() && source.size.pixels() == 0) {
            try {
                source.size = declared_size(source.bytes.data(), source.bytes.size(), image_name(image));
            } catch (const DeclaredSizeError& error) {
                refused.add(error.what());
            } catch (const Error& error) {
                source.problem = error.what();
            }
        }
        pixels += source.size.pixels(); // each texture has its own copy
    }
    refused.throw_if_any(source_.where());
    check_texture_budget(pixels, fmt::format("{}: {} textures", source_.where(), images_.size()));

    in_parallel(sources.size(), [&](size_t i) {
        Source& source = sources[i];
        if (!source.problem.empty()) return;
        try {
            scene_.textures[source.first].image =
                decode_image8(source.bytes.data(), source.bytes.size(), image_name(source.image));
        } catch (const std::exception& error) {
            source.problem = error.what();
        }
        source.file = {};
    });
    for (size_t i = 0; i < images_.size(); ++i) {
        const size_t first = sources[source_of[images_[i]]].first;
        if (first != i) scene_.textures[i].image = scene_.textures[first].image;
    }
    for (const Source& source : sources)
        if (!source.problem.empty()) scene_.notes.push_back("picture reads as white: " + source.problem);
    for (int i = int(images_.size()) - 1; i >= 0; --i)
        if (scene_.textures[size_t(i)].image.rgba.empty()) drop(i);
}

} // namespace bounce
