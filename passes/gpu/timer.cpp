#include "gpu/timer.h"

#include "gpu/objects.h"

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace bounce {

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// What glFinish is timed with. With BOUNCE_CPU_TIME in the environment it is the processor time that all threads of
/// the program took, which a software renderer's work can be told by on a machine that has other things to do.
static double finish_seconds() {
    static const bool by_work = std::getenv("BOUNCE_CPU_TIME") != nullptr;
    if (!by_work) return steady_seconds();
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

const char* to_string(TimerMode mode) {
    return mode == TimerMode::queries ? "GPU timestamp queries" : "glFinish and the CPU clock (queries read 0 here)";
}

TimerMode probe_timer_mode() {
    // A software renderer computes within the call and stamps its queries when it pleases: only the CPU's clock is
    // right.
    const GLubyte* renderer = glGetString(GL_RENDERER);
    const char* name = renderer ? reinterpret_cast<const char*>(renderer) : "";
    for (const char* software : {"llvmpipe", "softpipe", "SWR"}) {
        if (std::strstr(name, software)) return TimerMode::finish;
    }
    // A chain of dependent operations that takes a tenth of a millisecond or more anywhere.
    const char* source = "#version 460 core\n"
                         "layout(local_size_x = 64) in;\n"
                         "layout(std430, binding = 0) buffer Values { uint values[]; };\n"
                         "void main() { uint v = gl_GlobalInvocationID.x;\n"
                         "  for (int i = 0; i < 20000; ++i) v = v * 1664525u + 1013904223u;\n"
                         "  values[gl_GlobalInvocationID.x] = v; }\n";
    GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &source);
    Buffer values(8 * 64 * 4, nullptr, "timer probe");
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, values.id());
    glUseProgram(program);
    glDispatchCompute(8, 1, 1); // the first one compiles
    glFinish();
    // Several stretches without a flush between them: a driver may see the first and read 0 for the rest.
    constexpr int k_stretches = 3;
    GLuint queries[k_stretches + 1];
    GLuint64 times[k_stretches + 1] = {};
    glCreateQueries(GL_TIMESTAMP, k_stretches + 1, queries);
    double start = steady_seconds(); // some drivers compute within the call, others by the time of glFinish
    for (int i = 0; i <= k_stretches; ++i) {
        glQueryCounter(queries[i], GL_TIMESTAMP);
        if (i < k_stretches) glDispatchCompute(8, 1, 1);
    }
    glFinish();
    double finish = steady_seconds() - start;
    bool trusted = true;
    for (int i = 0; i <= k_stretches; ++i) {
        glGetQueryObjectui64v(queries[i], GL_QUERY_RESULT, &times[i]);
        // 20,000 dependent steps outlast the calls' own cost on any GPU.
        if (i > 0) trusted = trusted && double(times[i] - times[i - 1]) * 1e-9 > 0.05 * finish;
    }
    glDeleteQueries(k_stretches + 1, queries);
    glUseProgram(0);
    glDeleteProgram(program);
    return trusted ? TimerMode::queries : TimerMode::finish;
}

GpuTimer::GpuTimer(GpuTimer&& other) noexcept
    : mode_(other.mode_), ring_(other.ring_), head_(other.head_), recording_(other.recording_),
      started_(other.started_), ready_(other.ready_) {
    other.ring_ = {};
}

GpuTimer::~GpuTimer() {
    for (Pair& pair : ring_) {
        if (!pair.begin) continue;
        glDeleteQueries(1, &pair.begin);
        glDeleteQueries(1, &pair.end);
        live_objects().queries -= 2;
    }
}

bool GpuTimer::begin() {
    if (mode_ == TimerMode::finish) {
        glFinish();
        started_ = finish_seconds();
        return true;
    }
    Pair& pair = ring_[head_];
    recording_ = !pair.pending;
    if (!recording_) return false;
    if (!pair.begin) {
        glCreateQueries(GL_TIMESTAMP, 1, &pair.begin);
        glCreateQueries(GL_TIMESTAMP, 1, &pair.end);
        live_objects().queries += 2;
    }
    glQueryCounter(pair.begin, GL_TIMESTAMP);
    return true;
}

void GpuTimer::end() {
    if (mode_ == TimerMode::finish) {
        glFinish();
        ready_ = (finish_seconds() - started_) * 1e3;
        return;
    }
    if (!recording_) return;
    glQueryCounter(ring_[head_].end, GL_TIMESTAMP);
    ring_[head_].pending = true;
    head_ = (head_ + 1) % k_ring;
}

std::optional<double> GpuTimer::take() {
    // In the order of the frames; what is not ready is left for the next call.
    if (mode_ == TimerMode::queries) {
        for (int i = 0; i < k_ring; ++i) { // oldest first
            Pair& pair = ring_[(head_ + i) % k_ring];
            if (!pair.pending) continue;
            GLint available = 0;
            glGetQueryObjectiv(pair.end, GL_QUERY_RESULT_AVAILABLE, &available);
            if (!available) break;
            GLuint64 begin = 0, end = 0;
            glGetQueryObjectui64v(pair.begin, GL_QUERY_RESULT, &begin);
            glGetQueryObjectui64v(pair.end, GL_QUERY_RESULT, &end);
            pair.pending = false;
            return double(end - begin) * 1e-6;
        }
        return std::nullopt;
    }
    auto result = ready_;
    ready_.reset();
    return result;
}

} // namespace bounce
