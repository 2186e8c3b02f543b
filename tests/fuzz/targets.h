#pragma once
// What is fuzzed: for each kind of input a function that reads it as the program does. Bad input may only ever end in
// an Error. The same functions run under libFuzzer (`tests/run --fuzz SECONDS`) and, over the corpus, as a test.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bounce {

struct FuzzTarget {
    const char* name; ///< also of its corpus folder
    void (*run)(const uint8_t* data, size_t size);
};

const std::vector<FuzzTarget>& fuzz_targets();

} // namespace bounce
