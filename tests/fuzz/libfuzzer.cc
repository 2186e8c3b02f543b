// The entry points that libFuzzer calls; BOUNCE_FUZZ_TARGET names the target.

#include "fuzz/targets.h"

#include <cstdlib>
#include <cstring>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const bounce::FuzzTarget* target = [] {
        for (const bounce::FuzzTarget& known : bounce::fuzz_targets())
            if (std::strcmp(known.name, BOUNCE_FUZZ_TARGET) == 0) return &known;
        std::abort();
    }();
    target->run(data, size);
    return 0;
}
