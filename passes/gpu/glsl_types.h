#pragma once
// Sizes of GLSL's types and of the variables that a text declares.

#include "gpu/glsl_tokens.h"

#include <map>
#include <optional>
#include <span>

namespace bounce {

/// Bytes, and how many names a driver lists for it in a program's interface.
struct GlslSize {
    double bytes = 0, names = 1;
    bool aggregate = false; ///< a structure: each element of an array of it is listed
};

class GlslTypes {
  public:
    GlslTypes();
    /// The size of a type's name; null when it is none.
    const GlslSize* find(std::string_view type) const;
    void define(std::string_view name, const GlslSize& size) { sizes_[name] = size; }

  private:
    std::map<std::string_view, GlslSize> sizes_;
};

/// `count` elements of a size, per dimension.
GlslSize array_of(const GlslSize& element, double count);

} // namespace bounce
