#include "gpu/timer.h"

#include "gpu/objects.h"

#include <chrono>

namespace bounce {

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

const char* to_string(TimerMode mode) {
    return mode == TimerMode::queries ? "GPU timestamp queries" : "glFinish and the CPU clock (queries read 0 here)";
}

TimerMode probe_timer_mode() {
    // A chain of dependent operations that takes well over a microsecond anywhere.
    const char* source = "#version 460 core\n"
                         "layout(local_size_x = 64) in;\n"
                         "layout(std430, binding = 0) buffer Values { uint values[]; };\n"
                         "void main() { uint v = gl_GlobalInvocationID.x;\n"
                         "  for (int i = 0; i < 2000; ++i) v = v * 1664525u + 1013904223u;\n"
                         "  values[gl_GlobalInvocationID.x] = v; }\n";
    GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &source);
    Buffer values(64 * 64 * 4, nullptr, "timer probe");
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, values.id());
    glUseProgram(program);
    glDispatchCompute(64, 1, 1); // the first one compiles
    glFinish();
    GLuint queries[2];
    glCreateQueries(GL_TIMESTAMP, 2, queries);
    double start = steady_seconds(); // some drivers compute within the call, others by the time of glFinish
    glQueryCounter(queries[0], GL_TIMESTAMP);
    glDispatchCompute(64, 1, 1);
    glQueryCounter(queries[1], GL_TIMESTAMP);
    glFinish();
    double finish = steady_seconds() - start;
    GLuint64 begin = 0, end = 0;
    glGetQueryObjectui64v(queries[0], GL_QUERY_RESULT, &begin);
    glGetQueryObjectui64v(queries[1], GL_QUERY_RESULT, &end);
    glDeleteQueries(2, queries);
    glUseProgram(0);
    glDeleteProgram(program);
    double queried = double(end - begin) * 1e-9;
    // A GPU may finish in a fraction of the time that the CPU spends on the calls, but not in less than a microsecond.
    bool trusted = end > begin && (queried > 0.1 * finish || queried > 1e-6);
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

void GpuTimer::begin() {
    if (mode_ == TimerMode::finish) {
        glFinish();
        started_ = steady_seconds();
        return;
    }
    Pair& pair = ring_[head_];
    recording_ = !pair.pending; // the ring is full: this measurement is skipped rather than waited for
    if (!recording_) return;
    if (!pair.begin) {
        glCreateQueries(GL_TIMESTAMP, 1, &pair.begin);
        glCreateQueries(GL_TIMESTAMP, 1, &pair.end);
        live_objects().queries += 2;
    }
    glQueryCounter(pair.begin, GL_TIMESTAMP);
}

void GpuTimer::end() {
    if (mode_ == TimerMode::finish) {
        glFinish();
        ready_ = (steady_seconds() - started_) * 1e3;
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
