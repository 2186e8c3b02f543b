// A large copy arrives whole; how fast it is, is what bandwidths of passes are held against. BOUNCE_COPY_MIB sets its
// size.
#include "gpu/timer.h"
#include "support/gpu_context.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <vector>

using namespace bounce;

namespace {

size_t copy_words() {
    const char* text = std::getenv("BOUNCE_COPY_MIB");
    return size_t(std::clamp(text ? std::atoi(text) : 4, 1, 2047)) << 18;
}

} // namespace

class Copies : public GpuTest {};

TEST_F(Copies, ABufferArrivesWhole) {
    const size_t words = copy_words();
    std::vector<uint32_t> pattern(words);
    for (size_t i = 0; i < words; ++i)
        pattern[i] = uint32_t(i) * 2654435761u;
    GLuint buffers[2];
    glCreateBuffers(2, buffers);
    glNamedBufferStorage(buffers[0], GLsizeiptr(4 * words), pattern.data(), 0);
    glNamedBufferStorage(buffers[1], GLsizeiptr(4 * words), nullptr, 0);
    // Many in a row, since one alone is hardly longer than its submission.
    constexpr int k_copies = 8;
    double least = 1e30;
    for (int round = 0; round < 3; ++round) {
        glFinish();
        const double start = steady_seconds();
        for (int i = 0; i < k_copies; ++i)
            glCopyNamedBufferSubData(buffers[0], buffers[1], 0, 0, GLsizeiptr(4 * words));
        glFinish();
        least = std::min(least, steady_seconds() - start);
    }
    std::vector<uint32_t> copied(words);
    glGetNamedBufferSubData(buffers[1], 0, GLsizeiptr(4 * words), copied.data());
    glDeleteBuffers(2, buffers);
    EXPECT_TRUE(copied == pattern);
    const double gb_per_s = 2e-9 * k_copies * 4.0 * double(words) / least;
    RecordProperty("read_and_written_gb_per_s", std::to_string(gb_per_s));
    std::cout << "    copy: " << gb_per_s << " GB/s read and written\n";
}
