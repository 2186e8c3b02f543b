#include "app/ui/texture_view.h"

#include "core/error.h"
#include "core/paths.h"
#include "gpu/barrier.h"

#include <algorithm>
#include <array>
#include <bit>

namespace bounce {

// --- what to show ----------------------------------------------------------------------------------------------------

ViewerSettings default_view(const std::string& resource, const TextureDesc& desc) {
    ViewerSettings settings;
    settings.resource = resource;
    const Format& format = format_by_enum(desc.format);
    bool is_signed = std::string_view(format.name).ends_with("snorm") || resource.ends_with("normal");
    bool radiance = format.kind == FormatClass::floating && format.channels >= 3 && !is_signed;
    settings.encode_srgb = radiance || desc.format == GL_SRGB8_ALPHA8; // sampling decodes the latter
    if (is_signed) settings.low = -1;
    // What is no colour has no range that one could know beforehand.
    settings.automatic_range = !is_signed && (format.is_depth() || format.is_integer() ||
                                              (format.kind == FormatClass::floating && format.channels < 3));
    return settings;
}

ViewerSettings clamp_view(ViewerSettings settings, const TextureDesc& desc) {
    const Format& format = format_by_enum(desc.format);
    settings.mip = std::clamp(settings.mip, 0, desc.mips - 1);
    settings.layer = std::clamp(settings.layer, 0, mip_size(desc, settings.mip).z - 1);
    bool there = settings.channel == 5 ? format.channels >= 3 : settings.channel <= format.channels;
    if (settings.channel < 0 || !there) settings.channel = 0;
    return settings;
}

ViewerSettings shown_view(const Graph& graph, const UiState& ui) {
    for (const std::string& name : {ui.hovered, ui.pinned, ui.viewer.resource, std::string("out.display")}) {
        const GpuTexture* texture = name.empty() ? nullptr : graph.texture(name);
        if (!texture || !*texture) continue;
        return clamp_view(name == ui.viewer.resource ? ui.viewer : default_view(name, texture->desc()),
                          texture->desc());
    }
    return {};
}

void pin(UiState& ui, const Graph& graph, const std::string& resource) {
    const GpuTexture* texture = resource.empty() ? nullptr : graph.texture(resource);
    ui.pinned = texture ? resource : "";
    ui.viewer = texture ? default_view(resource, texture->desc()) : ViewerSettings();
    ui.redraw();
}

// --- the picture -----------------------------------------------------------------------------------------------------

namespace {
/// As the shaders have it: floats as unsigned integers of the same order.
uint32_t ordered_bits(float x) {
    auto bits = std::bit_cast<uint32_t>(x);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}
float from_ordered_bits(uint32_t bits) {
    return std::bit_cast<float>(bits & 0x80000000u ? bits & 0x7FFFFFFFu : ~bits);
}

struct FoundRange {
    uint32_t low = 0xFFFFFFFFu, high = 0, non_finite = 0;
};

const char* sampler_prefix(FormatClass kind) {
    return kind == FormatClass::unsigned_integer ? "u" : kind == FormatClass::signed_integer ? "i" : "";
}

const char* sampler_suffix(TextureKind kind) {
    switch (kind) {
    case TextureKind::texture_2d:
        return "sampler2D";
    case TextureKind::texture_2d_array:
        return "sampler2DArray";
    case TextureKind::texture_3d:
        return "sampler3D";
    }
    return "";
}

void set_constant(const Program& program, const char* name, const ParameterValue& value) {
    for (const UniformInfo& uniform : program.interface().uniforms) {
        if (uniform.name == name) set_uniform(program.id(), uniform, value);
    }
}

void dispatch(const Program& program, glm::ivec3 size) {
    glm::ivec3 local = program.interface().local_size;
    glDispatchCompute(GLuint((size.x + local.x - 1) / local.x), GLuint((size.y + local.y - 1) / local.y), 1);
}
} // namespace

// Texels are fetched, but a sampler must still find the texture complete: integers refuse linear filters.
TextureView::TextureView()
    : sampler_(GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, "texture view"),
      range_(sizeof(FoundRange), nullptr, "texture view range") {}

Program& TextureView::program(const char* file, const TextureDesc& desc) {
    std::string sampler = std::string(sampler_prefix(format_by_enum(desc.format).kind)) + sampler_suffix(desc.kind);
    std::unique_ptr<Program>& program = programs_[std::string(file) + " " + sampler];
    if (!program) {
        auto made = std::make_unique<Program>("texture view", std::vector<std::filesystem::path>{file}, glsl_folder());
        Defines defines = {{"TEXTURE_SAMPLER", sampler}};
        if (desc.kind == TextureKind::texture_2d) defines["TEXTURE_FLAT"] = "";
        made->scan(defines, {});
        if (!made->build({})) throw Error(made->errors().front().text());
        program = std::move(made);
    }
    return *program;
}

void TextureView::bind_source(const Program& program, const GpuTexture& source, const ViewerSettings& settings) const {
    glUseProgram(program.id());
    glBindTextureUnit(0, source.id());
    glBindSampler(0, sampler_.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, range_.id());
    set_constant(program, "mip", settings.mip);
    set_constant(program, "layer", settings.layer);
    set_constant(program, "channel", settings.channel);
    set_constant(program, "channels", format_by_enum(source.desc().format).channels);
    set_constant(program, "value_scale", scale_);
    set_constant(program, "logarithmic", int(settings.logarithmic));
}

void TextureView::find_range(const GpuTexture& source, const ViewerSettings& settings) {
    FoundRange range;
    if (!settings.automatic_range) range = {ordered_bits(settings.low), ordered_bits(settings.high), 0};
    range_.update(0, sizeof range, &range);
    if (!settings.automatic_range) return;
    const Program& finder = program("app/texture_range.comp", source.desc());
    bind_source(finder, source, settings);
    dispatch(finder, mip_size(source.desc(), settings.mip));
    memory_barrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

const GpuTexture& TextureView::draw(const GpuTexture& source, const ViewerSettings& wanted, float scale) {
    scale_ = scale;
    ViewerSettings settings = clamp_view(wanted, source.desc());
    glm::ivec3 size = mip_size(source.desc(), settings.mip);
    TextureDesc desc{TextureKind::texture_2d, GL_RGBA8, {size.x, size.y, 1}, 1};
    if (!picture_ || picture_.desc() != desc) {
        picture_ = GpuTexture(desc, "texture view");
        glTextureParameteri(picture_.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    memory_barrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    find_range(source, settings);
    const Program& viewer = program("app/texture_view.comp", source.desc());
    bind_source(viewer, source, settings);
    set_constant(viewer, "false_colour", int(settings.false_colour));
    set_constant(viewer, "encode_srgb", int(settings.encode_srgb));
    set_constant(viewer, "mark_non_finite", int(settings.mark_non_finite));
    glBindImageTexture(0, picture_.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA8);
    dispatch(viewer, size);
    memory_barrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    glBindSampler(0, 0);
    glUseProgram(0);
    return picture_;
}

std::vector<uint32_t> TextureView::histogram(const GpuTexture& source, const ViewerSettings& wanted) {
    const ViewerSettings settings = clamp_view(wanted, source.desc());
    std::vector<uint32_t> counts(k_histogram_steps + 2, 0);
    const uint64_t bytes = counts.size() * sizeof(uint32_t);
    if (!histogram_) histogram_ = Buffer(bytes, nullptr, "texture view histogram");
    histogram_.update(0, bytes, counts.data());
    const Program& counter = program("app/texture_histogram.comp", source.desc());
    bind_source(counter, source, settings);
    for (const BlockInfo& block : counter.interface().storage_blocks)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, block.binding,
                         block.name == "viewed_histogram" ? histogram_.id() : range_.id());
    dispatch(counter, mip_size(source.desc(), settings.mip));
    memory_barrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    histogram_.read(0, bytes, counts.data());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, 0);
    glBindSampler(0, 0);
    glUseProgram(0);
    return counts;
}

glm::vec2 TextureView::range() const {
    FoundRange range;
    range_.read(0, sizeof range, &range);
    if (range.low == 0xFFFFFFFFu) return {0, 1};
    return {from_ordered_bits(range.low), from_ordered_bits(range.high)};
}

uint32_t TextureView::non_finite() const {
    FoundRange range;
    range_.read(0, sizeof range, &range);
    return range.non_finite;
}

} // namespace bounce
