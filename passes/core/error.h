#pragma once
// The one way bad input is reported.

#include <stdexcept>
#include <string>
#include <vector>

namespace bounce {

/// Bad input (a file, shader, graph, parameter, size …). The text is one message that says what is wrong, where,
/// and what would be right. The program prints it and exits with code 2; a window shows it and goes on.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Collects the errors of one input so that all of them are told together.
class ErrorList {
  public:
    void add(std::string message) { messages_.push_back(std::move(message)); }
    bool empty() const { return messages_.empty(); }
    const std::vector<std::string>& messages() const { return messages_; }
    /// Throws an Error that names `where` and lists every message; does nothing when there are none.
    void throw_if_any(const std::string& where) const;

  private:
    std::vector<std::string> messages_;
};

} // namespace bounce
