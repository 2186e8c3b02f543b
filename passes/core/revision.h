#pragma once
// What a content was made of, as digests, told apart by why they may change; and where a struct's member lies, for
// inputs that are recorded by their place.

#include <array>
#include <cstddef>
#include <cstdint>

namespace bounce {

/// Why an input of a pass differs from the frame before.
enum class Cause {
    lasting, ///< somebody changed it: a shader, a parameter, what stands in the scene, the picture's size
    camera,  ///< the view moved
    passing  ///< time went on: frame index, what moves by itself, last frame's results
};
inline constexpr int k_causes = 3;

/// One digest a cause.
struct Revision {
    std::array<uint64_t, k_causes> by_cause{};
    uint64_t& operator[](Cause cause) { return by_cause[size_t(cause)]; }
    uint64_t operator[](Cause cause) const { return by_cause[size_t(cause)]; }
    bool operator==(const Revision&) const = default;
};

/// Bytes from the start of T to a member.
template <class T, class Member>
size_t offset_of(Member T::*member) {
    static const T origin{};
    return size_t(reinterpret_cast<const char*>(&(origin.*member)) - reinterpret_cast<const char*>(&origin));
}

} // namespace bounce
