#pragma once
// Pixel formats by the names graph files use ("rgba16f"), which are GLSL's layout qualifiers too.

#include <glad/gl.h>
#include <string>
#include <vector>

namespace bounce {

enum class FormatClass { floating, normalised, signed_integer, unsigned_integer, depth };

struct Format {
    const char* name; ///< "rgba16f"
    GLenum internal;  ///< GL_RGBA16F
    int channels;
    int bytes; ///< per texel
    FormatClass kind;
    bool image;        ///< may be bound as an image (load/store)
    GLenum transfer;   ///< format for uploads and readback (GL_RGBA, GL_RED_INTEGER …)
    GLenum clear_type; ///< type of clear values: GL_FLOAT, GL_INT or GL_UNSIGNED_INT

    bool is_integer() const { return kind == FormatClass::signed_integer || kind == FormatClass::unsigned_integer; }
    bool is_depth() const { return kind == FormatClass::depth; }
};

/// Throws Error with the nearest name.
const Format& format_by_name(const std::string& name);
/// Throws Error for a format that Bounce does not use.
const Format& format_by_enum(GLenum internal);
std::vector<std::string> format_names();

} // namespace bounce
