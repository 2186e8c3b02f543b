#include "gpu/format.h"

#include "core/error.h"
#include "core/text.h"

namespace bounce {

using enum FormatClass;
static const Format k_formats[] = {
    {"r8", GL_R8, 1, 1, normalised, true, GL_RED, GL_FLOAT},
    {"rg8", GL_RG8, 2, 2, normalised, true, GL_RG, GL_FLOAT},
    {"rgba8", GL_RGBA8, 4, 4, normalised, true, GL_RGBA, GL_FLOAT},
    {"srgb8_alpha8", GL_SRGB8_ALPHA8, 4, 4, normalised, false, GL_RGBA, GL_FLOAT},
    {"rgba8_snorm", GL_RGBA8_SNORM, 4, 4, normalised, true, GL_RGBA, GL_FLOAT},
    {"rgb10_a2", GL_RGB10_A2, 4, 4, normalised, true, GL_RGBA, GL_FLOAT},
    {"r16", GL_R16, 1, 2, normalised, true, GL_RED, GL_FLOAT},
    {"rg16", GL_RG16, 2, 4, normalised, true, GL_RG, GL_FLOAT},
    {"rgba16", GL_RGBA16, 4, 8, normalised, true, GL_RGBA, GL_FLOAT},
    {"rg16_snorm", GL_RG16_SNORM, 2, 4, normalised, true, GL_RG, GL_FLOAT},
    {"rgba16_snorm", GL_RGBA16_SNORM, 4, 8, normalised, true, GL_RGBA, GL_FLOAT},
    {"r16f", GL_R16F, 1, 2, floating, true, GL_RED, GL_FLOAT},
    {"rg16f", GL_RG16F, 2, 4, floating, true, GL_RG, GL_FLOAT},
    {"rgba16f", GL_RGBA16F, 4, 8, floating, true, GL_RGBA, GL_FLOAT},
    {"r32f", GL_R32F, 1, 4, floating, true, GL_RED, GL_FLOAT},
    {"rg32f", GL_RG32F, 2, 8, floating, true, GL_RG, GL_FLOAT},
    {"rgba32f", GL_RGBA32F, 4, 16, floating, true, GL_RGBA, GL_FLOAT},
    {"r11f_g11f_b10f", GL_R11F_G11F_B10F, 3, 4, floating, true, GL_RGB, GL_FLOAT},
    {"r8ui", GL_R8UI, 1, 1, unsigned_integer, true, GL_RED_INTEGER, GL_UNSIGNED_INT},
    {"r16ui", GL_R16UI, 1, 2, unsigned_integer, true, GL_RED_INTEGER, GL_UNSIGNED_INT},
    {"r32ui", GL_R32UI, 1, 4, unsigned_integer, true, GL_RED_INTEGER, GL_UNSIGNED_INT},
    {"rg32ui", GL_RG32UI, 2, 8, unsigned_integer, true, GL_RG_INTEGER, GL_UNSIGNED_INT},
    {"rgba8ui", GL_RGBA8UI, 4, 4, unsigned_integer, true, GL_RGBA_INTEGER, GL_UNSIGNED_INT},
    {"rgba32ui", GL_RGBA32UI, 4, 16, unsigned_integer, true, GL_RGBA_INTEGER, GL_UNSIGNED_INT},
    {"r32i", GL_R32I, 1, 4, signed_integer, true, GL_RED_INTEGER, GL_INT},
    {"depth16", GL_DEPTH_COMPONENT16, 1, 2, depth, false, GL_DEPTH_COMPONENT, GL_FLOAT},
    {"depth24", GL_DEPTH_COMPONENT24, 1, 4, depth, false, GL_DEPTH_COMPONENT, GL_FLOAT},
    {"depth32f", GL_DEPTH_COMPONENT32F, 1, 4, depth, false, GL_DEPTH_COMPONENT, GL_FLOAT},
};

const Format& format_by_name(const std::string& name) {
    for (const Format& format : k_formats) {
        if (name == format.name) return format;
    }
    throw Error("there is no format '" + name + "'" + did_you_mean(name, format_names()));
}

const Format& format_by_enum(GLenum internal) {
    for (const Format& format : k_formats) {
        if (internal == format.internal) return format;
    }
    throw Error("internal format " + std::to_string(internal) + " is not one that Bounce uses");
}

std::vector<std::string> format_names() {
    std::vector<std::string> names;
    for (const Format& format : k_formats)
        names.push_back(format.name);
    return names;
}

} // namespace bounce
