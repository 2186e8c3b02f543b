// Reads every input of the corpus as the fuzzer does, those that once did harm among them: whole, cut off, and changed
// in ways that are the same in every run.

#include "fuzz/targets.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sstream>

namespace bounce {

namespace fs = std::filesystem;

namespace {

/// One to four changes: a bit, a byte, a number that is at the edge of its type, a piece taken out or repeated.
std::string changed(std::string bytes, std::mt19937& random) {
    auto below = [&](size_t count) { return size_t(random() % std::max<size_t>(count, 1)); };
    for (size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
        const size_t at = below(bytes.size()), length = 1 + below(std::min<size_t>(bytes.size() - at, 16));
        switch (below(6)) {
        case 0:
            bytes[at] = char(bytes[at] ^ (1 << below(8)));
            break;
        case 1:
            bytes[at] = char(random());
            break;
        case 2:
            for (size_t i = 0; i < std::min<size_t>(4, bytes.size() - at); ++i)
                bytes[at + i] = "\xff\x7f\0\x80"[below(4)];
            break;
        case 3:
            bytes.erase(at, length);
            break;
        case 4:
            bytes.insert(at, bytes.substr(at, length));
            break;
        default: {
            static const char* const numbers[] = {"-1",  "0",   "1e39", "4294967296", "99999999999999999999",
                                                  "0.5", "null"};
            bytes.replace(at, 1, numbers[below(std::size(numbers))]);
        }
        }
    }
    return bytes;
}

/// How many changed forms of each input are read; $BOUNCE_FUZZ_CHANGES sets another number.
int changes_of_each() {
    const char* set = std::getenv("BOUNCE_FUZZ_CHANGES");
    return set ? std::atoi(set) : 30;
}

void run(const FuzzTarget& target, const std::string& bytes) {
    EXPECT_NO_THROW(target.run(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()));
}

} // namespace

class Corpus : public testing::TestWithParam<FuzzTarget> {};

TEST_P(Corpus, IsReadWithoutHarm) {
    const fs::path folder = fs::path(BOUNCE_TESTS_DIR) / "fuzz" / "corpus" / GetParam().name;
    std::vector<fs::path> inputs;
    for (const auto& entry : fs::directory_iterator(folder))
        inputs.push_back(entry.path());
    std::sort(inputs.begin(), inputs.end());
    ASSERT_FALSE(inputs.empty()) << folder;
    std::mt19937 random(1);
    for (const fs::path& input : inputs) {
        std::ostringstream text;
        text << std::ifstream(input, std::ios::binary).rdbuf();
        const std::string bytes = text.str();
        SCOPED_TRACE(input.string());
        for (size_t length = bytes.size();; length -= 1 + length / 8) {
            run(GetParam(), bytes.substr(0, length));
            if (length == 0) break;
        }
        for (int i = 0; i < changes_of_each(); ++i)
            run(GetParam(), changed(bytes, random));
    }
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Corpus, testing::ValuesIn(fuzz_targets()),
                         [](const auto& target) { return std::string(target.param.name); });

} // namespace bounce
