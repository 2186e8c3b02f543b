#include "graph/counters.h"

#include "gpu/barrier.h"

namespace bounce {

constexpr size_t k_max_pending = 3; // frames; beyond them the newest is skipped, never waited for

bool Counters::collect(const Plan& plan, const Allocations& allocations) {
    bool news = take(0);
    std::vector<CounterValue> values;
    for (const PlanPass& pass : plan.passes) {
        for (const PlanCounter& counter : pass.counters)
            values.push_back({pass.id, counter.label, 0, counter.overflow});
    }
    if (values.empty()) {
        newest_.clear();
        return false;
    }
    if (pending_.size() >= k_max_pending) return news;
    Pending next;
    uint64_t bytes = values.size() * sizeof(uint32_t);
    for (Buffer& buffer : spare_) {
        if (buffer && buffer.bytes() == bytes) next.copy = std::move(buffer);
    }
    std::erase_if(spare_, [](const Buffer& buffer) { return !buffer; });
    if (!next.copy)
        next.copy = Buffer(bytes, nullptr, "counters read back", GL_DYNAMIC_STORAGE_BIT | GL_CLIENT_STORAGE_BIT);
    memory_barrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    GLintptr at = 0;
    for (const PlanPass& pass : plan.passes) {
        for (const PlanCounter& counter : pass.counters) {
            glCopyNamedBufferSubData(allocations.buffer(counter.resource).id(), next.copy.id(),
                                     GLintptr(counter.element) * GLintptr(sizeof(uint32_t)), at, sizeof(uint32_t));
            at += GLintptr(sizeof(uint32_t));
        }
    }
    next.fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    next.values = std::move(values);
    pending_.push_back(std::move(next));
    return news;
}

bool Counters::take(GLuint64 wait) {
    bool news = false;
    while (!pending_.empty()) {
        Pending& oldest = pending_.front();
        GLenum state = glClientWaitSync(oldest.fence, GL_SYNC_FLUSH_COMMANDS_BIT, wait);
        if (state != GL_ALREADY_SIGNALED && state != GL_CONDITION_SATISFIED) return news;
        std::vector<int32_t> numbers(oldest.values.size());
        oldest.copy.read(0, numbers.size() * sizeof(int32_t), numbers.data());
        for (size_t i = 0; i < numbers.size(); ++i)
            oldest.values[i].value = numbers[i];
        newest_ = std::move(oldest.values);
        glDeleteSync(oldest.fence);
        spare_.push_back(std::move(oldest.copy));
        pending_.pop_front();
        news = true;
    }
    return news;
}

bool Counters::finish() {
    return take(10'000'000'000); // ns
}

void Counters::drop() {
    for (Pending& pending : pending_)
        glDeleteSync(pending.fence);
    pending_.clear();
    spare_.clear();
    newest_.clear();
}

} // namespace bounce
