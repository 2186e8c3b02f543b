#pragma once
// The opaque uniforms and storage blocks that a shader's text declares. Declarations may be written over several lines,
// several on one, and several names behind one type.

#include "gpu/shader_source.h"

#include <string>
#include <string_view>
#include <vector>

namespace bounce {

class SlotReader {
  public:
    struct Found {
        ShaderSlot slot;  ///< without what the note says, `where` and `certain`
        std::string note; ///< what follows "//!" on the lines of its declaration
    };
    /// One more line of code, without comments. `mark` is what follows "//!" there. Returns the slots that are complete
    /// with it.
    std::vector<Found> read(std::string_view code, std::string_view mark);

  private:
    void finish_uniform(std::vector<Found>& found);
    void finish_block(std::vector<Found>& found);
    Found slot_of(SlotKind kind, const std::string& type, const std::string& identifier) const;
    bool has(std::string_view word) const;

    std::vector<std::string> words_; ///< of the declaration that is being read, with its punctuation
    bool too_long_ = false;          ///< it is no declaration of a slot
    std::string note_;
};

} // namespace bounce
