#pragma once
// States of renders in the user's cache folder. A render leaves one file for each goal it reached, and one where it
// broke off.

#include "reference/render.h"

#include <functional>
#include <optional>

namespace bounce {

/// What is known of a kept state without reading its pixels.
struct KeptState {
    std::filesystem::path path;
    int samples = 0;     ///< the least of any pixel
    int max_samples = 0; ///< the most
};

/// All states of one key, fewest samples first. Damaged files are left out.
std::vector<KeptState> kept_states(const std::string& key);

/// Keeps the state. `partial` ones replace each other; full ones are kept by their number of samples. Throws Error, for
/// example on a full disk.
void keep_state(const ReferenceRender& render, bool partial);
void forget_partial_state(const std::string& key);

/// Deletes the oldest states until no more than `bytes` are used. `spare` is never deleted.
void prune_states(uint64_t bytes, const std::string& spare_key);

} // namespace bounce
