#include "app/capture.h"

#include "commit.h"
#include "core/error.h"
#include "core/exr_file.h"
#include "core/json_text.h"
#include "core/log.h"
#include "core/output_file.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace fs = std::filesystem;

const char* program_commit() {
    return BOUNCE_COMMIT;
}

static std::string gl_text(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
}

std::string picture_metadata(const Session& session, const std::string& resource) {
    nlohmann::ordered_json json;
    json["program"] = "bounce";
    json["commit"] = program_commit();
    json["shot"] = session.options().shot;
    json["graph"] = session.options().graph;
    if (!resource.empty()) json["resource"] = resource;
    json["size"] = {session.size().x, session.size().y};
    json["frame"] = session.frame();
    json["time"] = session.time();
    json["camera"] = nlohmann::ordered_json::parse(camera_json(session.camera(), session.shot().scene.space));
    nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
    for (const auto& [name, text] : session.changed_parameters(ParameterOrigin::graph))
        parameters[name] = text;
    json["parameters"] = parameters;
    json["renderer"] = gl_text(GL_RENDERER);
    json["driver"] = gl_text(GL_VERSION);
    return json_dump(json);
}

/// The fourth channel of what is light is no light (an opacity, a cosine).
static void scale_light(Image& image, float scale) {
    if (scale == 1) return;
    for (size_t i = 0; i < image.pixels.size(); ++i)
        if (int(i % size_t(image.channels)) < 3) image.pixels[i] *= scale;
}

Image read_layer(const GpuTexture& texture, int mip, int layer, float scale) {
    glm::ivec3 size = mip_size(texture.desc(), mip);
    int channels = format_by_enum(texture.desc().format).channels;
    std::vector<float> all = texture.read(mip);
    Image image(size.x, size.y, channels);
    size_t stride = image.pixels.size();
    size_t first = stride * size_t(std::clamp(layer, 0, size.z - 1));
    std::copy_n(all.begin() + long(first), stride, image.pixels.begin());
    scale_light(image, scale);
    return image;
}

/// Parts are radiance: three channels are enough.
static Image without_alpha(const Image& image) {
    if (image.channels != 4) return image;
    Image out(image.width, image.height, 3);
    for (size_t i = 0; i < size_t(image.width) * image.height; ++i)
        std::copy_n(&image.pixels[4 * i], 3, &out.pixels[3 * i]);
    return out;
}

LayeredImage read_parts(const Session& session) {
    LayeredImage parts;
    for (const PlanResource& known : session.graph().plan().resources) {
        bool part = known.name().starts_with("out.") && known.name() != "out.display" && !known.is_buffer();
        if (!part) continue;
        const GpuTexture& texture = *session.graph().texture(known.name());
        parts.layers[known.name()] = without_alpha(read_layer(texture, 0, 0, session.value_scale(known.name())));
    }
    return parts;
}

static Image8 to_display(const Image& image, bool encoded) {
    Image8 out{image.width, image.height, std::vector<uint8_t>(size_t(image.width) * image.height * 4, 255)};
    for (size_t i = 0; i < size_t(image.width) * image.height; ++i) {
        for (int c = 0; c < 3; ++c) {
            float value = image.pixels[i * size_t(image.channels) + size_t(std::min(c, image.channels - 1))];
            if (image.channels == 2 && c == 2) value = 0;
            value = std::isnan(value) ? 0 : std::clamp(value, 0.0f, 1.0f);
            if (!encoded) value = srgb_encode(value);
            out.rgba[4 * i + size_t(c)] = uint8_t(std::lround(255 * value));
        }
    }
    return out;
}

static const GpuTexture& find_texture(const Session& session, const std::string& resource) {
    if (const GpuTexture* texture = session.graph().texture(resource)) return *texture;
    std::vector<std::string> names;
    for (const PlanResource& known : session.graph().plan().resources) {
        if (!known.is_buffer()) names.push_back(known.name());
    }
    for (const PlanSkip& skipped : session.graph().plan().skipped) {
        const PassNode* node = session.graph().model().find_node(skipped.id);
        for (const auto& program : node->programs) {
            for (const ShaderSlot& slot : program->slots()) {
                if (slot.writes && slot.name == resource) {
                    throw Error(fmt::format("graph '{}' does not make '{}' here: pass '{}' is skipped ({})",
                                            session.options().graph, resource, skipped.id, skipped.reason));
                }
            }
        }
    }
    throw Error(fmt::format("graph '{}' makes no texture '{}'{}", session.options().graph, resource,
                            did_you_mean(resource, names)));
}

static double float_bytes(const TextureDesc& desc) {
    return double(desc.size.x) * desc.size.y * desc.size.z * format_by_enum(desc.format).channels * sizeof(float);
}

double picture_bytes(const Session& session, const fs::path& path, const std::string& resource) {
    const bool png = path.extension() == ".png";
    const std::string shown = resource.empty() && png ? "out.display" : resource;
    double parts = 0, largest = 0;
    for (const PlanResource& known : session.graph().plan().resources) {
        const bool part =
            shown.empty() ? known.name().starts_with("out.") && known.name() != "out.display" : known.name() == shown;
        if (!part || known.is_buffer()) continue;
        parts += float_bytes(known.texture);
        largest = std::max(largest, float_bytes(known.texture));
    }
    // One part twice while it is copied; a PNG's 8-bit copies are an eighth each; an EXR's file may be as large as its
    // parts.
    return png ? 2 * largest + largest / 4 : 2 * parts + largest;
}

void check_output_path(const fs::path& path) {
    std::string extension = path.extension().string();
    if (extension != ".exr" && extension != ".png") {
        throw Error(fmt::format("invalid output name '{}': expected one that ends in .exr or .png", path.string()));
    }
    check_output_file(path);
}

void check_output_file(const fs::path& path) {
    check_writable(path);
}

/// Half floats end at 65504, and so do the shaders' stores. The pre-exposure is chosen so that this is rare; where it
/// happens all the same (a lamp that nearly touches a surface), the picture is too dark there.
static void warn_of_clipping(const Session& session) {
    for (const PlanResource& known : session.graph().plan().resources) {
        const bool part = known.name().starts_with("out.") && known.declaration.radiance && !known.is_buffer();
        if (!part || known.name() == "out.radiance") continue;
        const GpuTexture& texture = *session.graph().texture(known.name());
        const Format& format = format_by_enum(texture.desc().format);
        if (format.kind != FormatClass::floating || format.bytes / format.channels != 2) continue;
        const Image stored = read_layer(texture);
        size_t clipped = 0;
        for (int y = 0; y < stored.height; ++y)
            for (int x = 0; x < stored.width; ++x) {
                const float* texel = stored.at(x, y);
                clipped +=
                    std::any_of(texel, texel + std::min(stored.channels, 3), [](float v) { return !(v < 65504); });
            }
        if (clipped)
            spdlog::warn("{}: {} pixel{} clipped at {:.4g} W/(sr·m²), the most that half floats hold at this scene's "
                         "pre-exposure",
                         known.name(), clipped, clipped == 1 ? " is" : "s are",
                         65504 * session.value_scale(known.name()));
    }
}

Image8 display_picture(const Session& session, const std::string& resource) {
    const GpuTexture& texture = find_texture(session, resource.empty() ? "out.display" : resource);
    const bool encoded = resource.empty() || resource == "out.display";
    return to_display(read_layer(texture, 0, 0, session.value_scale(resource)), encoded);
}

void write_picture(const Session& session, const fs::path& path, const std::string& resource) {
    check_output_path(path);
    if (resource.empty()) warn_of_clipping(session);
    if (path.extension() == ".png") {
        write_png(path, display_picture(session, resource));
        return;
    }
    LayeredImage image;
    std::string default_layer;
    image.metadata = picture_metadata(session, resource);
    if (resource.empty()) {
        image.layers = read_parts(session).layers;
        if (image.layers.empty()) throw Error("graph '" + session.options().graph + "' makes no out.* part to write");
        default_layer = image.layers.contains("out.radiance") ? "out.radiance" : image.layers.begin()->first;
    } else {
        const GpuTexture& texture = find_texture(session, resource);
        const TextureDesc& desc = texture.desc();
        default_layer = desc.size.z == 1 ? resource : resource + ".0";
        if (desc.size.z == 1)
            image.layers[resource] = read_layer(texture, 0, 0, session.value_scale(resource));
        else {
            std::vector<float> all = texture.read(0);
            int channels = format_by_enum(desc.format).channels;
            size_t stride = size_t(desc.size.x) * desc.size.y * channels;
            for (int z = 0; z < desc.size.z; ++z) {
                Image layer(desc.size.x, desc.size.y, channels);
                std::copy_n(all.begin() + long(stride * size_t(z)), stride, layer.pixels.begin());
                scale_light(layer, session.value_scale(resource));
                image.layers[fmt::format("{}.{}", resource, z)] = std::move(layer);
            }
        }
    }
    write_exr(path, image, default_layer);
}

} // namespace bounce
