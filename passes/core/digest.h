#pragma once
// A 64-bit digest of values in order, to tell whether they are what they were. The same on every machine of the same
// byte order; no cryptography.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace bounce {

class Digest {
  public:
    Digest& bytes(const void* data, size_t size) {
        const auto* from = static_cast<const unsigned char*>(data);
        mix(size);
        for (; size >= 8; from += 8, size -= 8) {
            uint64_t word;
            std::memcpy(&word, from, 8);
            mix(word);
        }
        if (size == 0) return *this; // where `data` may be null
        uint64_t rest = 0;
        std::memcpy(&rest, from, size);
        mix(rest);
        return *this;
    }
    Digest& add(std::string_view text) { return bytes(text.data(), text.size()); }
    /// A value without padding (its bytes are what is compared).
    template <typename T>
    requires std::is_trivially_copyable_v<T> &&
        (!std::is_convertible_v<T, std::string_view>)Digest& add(const T& value) {
        return bytes(&value, sizeof value);
    }
    uint64_t value() const { return state_; }

  private:
    /// A step of MurmurHash3's 64-bit finalizer (Appleby 2011).
    void mix(uint64_t word) {
        state_ = (state_ ^ word) * 0xff51afd7ed558ccdull;
        state_ = (state_ ^ (state_ >> 33)) * 0xc4ceb9fe1a85ec53ull;
        state_ ^= state_ >> 33;
    }
    uint64_t state_ = 0x9e3779b97f4a7c15ull;
};

} // namespace bounce
