#pragma once
// A name for everything that shapes a reference image, so that equal renders are found again.

#include "reference/settings.h"
#include "scene/shot.h"

#include <cstdint>
#include <string>

namespace bounce {

/// A 128-bit hash of bytes, fed in order.
class ContentHash {
  public:
    void add(const void* data, size_t size);
    void add(const std::string& text);
    /// Numbers and vectors of them (nothing with padding).
    template <class T>
    void add_value(const T& value) {
        add(&value, sizeof(T));
    }
    /// 32 hexadecimal digits.
    std::string text() const;

  private:
    void mix(uint64_t word);
    uint64_t a_ = 0x9e3779b97f4a7c15ull, b_ = 0xc2b2ae3d27d4eb4full;
};

/// The key of the shot at one frame (its evaluated state), the settings that change results, and the tracer's version.
/// Where files are and what things are called does not matter; what the camera sees does.
std::string content_key(const Shot& shot, const ShotState& state, const ReferenceSettings& settings);

/// The shot alone, at its first `frames` frames: scene, lights, environment and cameras, whatever looks at it. Its size
/// does not count.
std::string shot_digest(const Shot& shot, int frames);

} // namespace bounce
