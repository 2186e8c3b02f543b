#pragma once
// Reads a JSON object key by key: each read checks type and range and adds what is wrong to a list; `finish` adds the
// keys that nobody asked for, with the nearest one that is known.

#include "core/error.h"

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace bounce {

class JsonObject {
  public:
    /// `where` names the object in messages ("lights[0]"; empty for the file's root). A value that is no object is
    /// an error, and reads as empty.
    JsonObject(const nlohmann::json& value, std::string where, ErrorList& errors);

    bool has(const char* key) const { return value_->contains(key); }
    /// The value, or null when absent; marks the key as known.
    const nlohmann::json* find(const char* key);
    /// An error when `key` is absent.
    void require(const char* key, const char* what);

    std::optional<float> number(const char* key, double least, double most);
    std::optional<int> whole(const char* key, int least, int most);
    std::optional<bool> boolean(const char* key);
    std::optional<std::string> text(const char* key);
    std::optional<glm::dvec3> vector(const char* key);
    /// A number (grey) or an array of 3, none negative.
    std::optional<glm::vec3> colour(const char* key);
    /// One of `names`; its index.
    std::optional<size_t> choice(const char* key, const std::vector<std::string>& names);

    void finish();

    /// "lights[0].position" for messages about a key.
    std::string at(const std::string& key) const { return where_.empty() ? key : where_ + "." + key; }
    ErrorList& errors() { return errors_; }

  private:
    std::nullopt_t fail(const char* key, const std::string& wanted);

    const nlohmann::json* value_;
    std::string where_;
    ErrorList& errors_;
    std::vector<std::string> known_;
};

/// As json_kind, but a short array of numbers is told by them: "[1e+31,0,0]".
std::string json_shown(const nlohmann::json& value);

/// An array of 3 numbers, none above 1e30 in size.
std::optional<glm::dvec3> json_vector(const nlohmann::json& value);

} // namespace bounce
