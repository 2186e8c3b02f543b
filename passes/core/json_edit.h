#pragma once
// Edits the text of a JSON file in place, so that its comments and its layout stay.

#include <string>
#include <vector>

namespace bounce {

/// The text of a JSON document with // and /* */ comments. It must be well-formed (a reader has accepted it).
class JsonEdit {
  public:
    explicit JsonEdit(std::string text) : text_(std::move(text)) {}
    const std::string& text() const { return text_; }

    /// Sets a member of the object at `path` (names of members, and numbers of elements) to a JSON text; makes the
    /// objects on the way. Throws Error where the path leads through what is no object or list.
    void set(const std::vector<std::string>& path, const std::string& value);
    /// Adds an element to the list at `path`, before element `before` or, when there are fewer, at its end. Makes an
    /// empty list when there is none.
    void insert(const std::vector<std::string>& path, size_t before, const std::string& value);

  private:
    std::string text_;
};

} // namespace bounce
