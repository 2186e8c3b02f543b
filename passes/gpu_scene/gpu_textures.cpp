// The texture part of GpuScene: size-bucketed arrays, and 2D views of their layers.
#include "core/error.h"
#include "core/log.h"
#include "core/mip_chain.h"
#include "gpu_scene/gpu_scene.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stb_image_resize.h>
#include <tuple>

namespace bounce {

static GLenum gl_wrap(Wrap wrap) {
    switch (wrap) {
    case Wrap::repeat:
        return GL_REPEAT;
    case Wrap::mirrored_repeat:
        return GL_MIRRORED_REPEAT;
    case Wrap::clamp_to_edge:
        return GL_CLAMP_TO_EDGE;
    }
    return GL_REPEAT;
}

GLuint GpuScene::sampler_for(Wrap u, Wrap v, bool nearest) {
    int key = int(u) * 8 + int(v) * 2 + int(nearest);
    auto found = samplers_.find(key);
    if (found == samplers_.end()) {
        Sampler sampler(nearest ? GL_NEAREST_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_LINEAR, nearest ? GL_NEAREST : GL_LINEAR,
                        GL_REPEAT, "material sampler");
        sampler.set_wrap(gl_wrap(u), gl_wrap(v));
        found = samplers_.emplace(key, std::move(sampler)).first;
    }
    return found->second.id();
}

namespace {
/// Textures that can share one array.
struct Bucket {
    glm::ivec2 size;
    bool srgb;
    Wrap wrap_u, wrap_v;
    bool nearest;
    std::vector<int> textures;
};

bool same_kind(const Bucket& a, const Bucket& b) {
    return std::tie(a.srgb, a.wrap_u, a.wrap_v, a.nearest) == std::tie(b.srgb, b.wrap_u, b.wrap_v, b.nearest);
}

std::vector<Bucket> fill_buckets(const Scene& scene) {
    std::vector<Bucket> buckets;
    for (size_t i = 0; i < scene.textures.size(); ++i) {
        const Texture& texture = scene.textures[i];
        if (texture.image.rgba.empty()) continue;
        Bucket wanted{{texture.image.width, texture.image.height},
                      texture.srgb,
                      texture.wrap_u,
                      texture.wrap_v,
                      texture.nearest,
                      {}};
        auto found = std::find_if(buckets.begin(), buckets.end(),
                                  [&](const Bucket& b) { return b.size == wanted.size && same_kind(b, wanted); });
        if (found == buckets.end()) found = buckets.insert(buckets.end(), wanted);
        found->textures.push_back(int(i));
    }
    return buckets;
}

/// Joins buckets until there are few enough: first those that differ in size only, then those that differ in wrapping.
/// Colour encodings are never mixed.
void join_buckets(std::vector<Bucket>& buckets, size_t most) {
    auto area = [](const Bucket& b) { return double(b.size.x) * b.size.y; };
    while (buckets.size() > most) {
        size_t best_a = 0, best_b = 0;
        double best_cost = 1e300;
        for (size_t a = 0; a < buckets.size(); ++a) {
            for (size_t b = 0; b < buckets.size(); ++b) {
                if (a == b || buckets[a].srgb != buckets[b].srgb) continue;
                // b's textures would be resampled to a's size.
                double cost =
                    std::abs(std::log2(area(buckets[a]) / area(buckets[b]))) * double(buckets[b].textures.size());
                if (area(buckets[b]) > area(buckets[a])) cost += 50;
                if (!same_kind(buckets[a], buckets[b])) cost += 1000;
                if (cost < best_cost) best_cost = cost, best_a = a, best_b = b;
            }
        }
        auto& into = buckets[best_a].textures;
        auto& from = buckets[best_b].textures;
        into.insert(into.end(), from.begin(), from.end());
        buckets.erase(buckets.begin() + long(best_b));
    }
}

std::vector<uint8_t> resized(const Texture& texture, glm::ivec2 size) {
    const Image8& image = texture.image;
    if (image.width == size.x && image.height == size.y) return image.rgba;
    std::vector<uint8_t> out(size_t(size.x) * size.y * 4);
    if (texture.srgb) {
        stbir_resize_uint8_srgb(image.rgba.data(), image.width, image.height, 0, out.data(), size.x, size.y, 0, 4, 3,
                                0);
    } else {
        stbir_resize_uint8(image.rgba.data(), image.width, image.height, 0, out.data(), size.x, size.y, 0, 4);
    }
    return out;
}
} // namespace

/// By texture, the alpha at which a masked material that reads it as its base colour cuts; 0 where none does.
static std::vector<float> mask_cutoffs(const Scene& scene) {
    std::vector<float> cutoffs(scene.textures.size(), 0.0f);
    for (const Material& material : scene.materials) {
        const int texture = material.base_colour_texture.texture;
        if (material.alpha_mode != AlphaMode::mask || texture < 0 || !(material.base_colour.a > 0)) continue;
        cutoffs[size_t(texture)] = material.alpha_cutoff / material.base_colour.a;
    }
    return cutoffs;
}

void GpuScene::upload_textures(const Scene& scene) {
    const std::vector<float> cutoffs = mask_cutoffs(scene);
    std::vector<Bucket> buckets = fill_buckets(scene);
    join_buckets(buckets, k_texture_arrays);
    places_.assign(scene.textures.size(), {-1, 0});
    views_.resize(scene.textures.size());
    view_samplers_.assign(scene.textures.size(), 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (Bucket& bucket : buckets) {
        TextureDesc desc{TextureKind::texture_2d_array, GLenum(bucket.srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8),
                         glm::ivec3(bucket.size, int(bucket.textures.size())), 1};
        desc.mips = full_mip_count(desc);
        int array_index = int(arrays_.size());
        Array array{GpuTexture(desc, fmt::format("scene.textures[{}]", array_index)),
                    sampler_for(bucket.wrap_u, bucket.wrap_v, bucket.nearest)};
        for (size_t layer = 0; layer < bucket.textures.size(); ++layer) {
            int index = bucket.textures[layer];
            const Image8 whole{bucket.size.x, bucket.size.y, resized(scene.textures[size_t(index)], bucket.size)};
            auto upload = [&](int mip, const Image8& image) {
                glTextureSubImage3D(array.texture.id(), mip, 0, 0, GLint(layer), image.width, image.height, 1, GL_RGBA,
                                    GL_UNSIGNED_BYTE, image.rgba.data());
            };
            upload(0, whole);
            int mip = 0;
            std::vector<Image8> levels = mip_chain(whole, bucket.srgb);
            if (cutoffs[size_t(index)] > 0) keep_coverage(whole, levels, cutoffs[size_t(index)]);
            for (const Image8& smaller : levels)
                upload(++mip, smaller);
            places_[size_t(index)] = {array_index, int(layer)};
        }
        for (size_t layer = 0; layer < bucket.textures.size(); ++layer) {
            size_t index = size_t(bucket.textures[layer]);
            const Texture& texture = scene.textures[index];
            views_[index] = array.texture.view(TextureKind::texture_2d, 0, desc.mips, int(layer), 1);
            view_samplers_[index] = sampler_for(texture.wrap_u, texture.wrap_v, texture.nearest);
        }
        arrays_.push_back(std::move(array));
    }
}

} // namespace bounce
