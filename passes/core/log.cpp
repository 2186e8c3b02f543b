#include "core/log.h"

#include <memory>
#include <mutex>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

namespace bounce {

namespace {
constexpr size_t k_history = 400;

class HistorySink : public spdlog::sinks::base_sink<std::mutex> {
  public:
    std::deque<LogLine> copy() {
        std::lock_guard lock(mutex_);
        return lines_;
    }

  private:
    void sink_it_(const spdlog::details::log_msg& message) override {
        lines_.push_back({message.level, std::string(message.payload.data(), message.payload.size())});
        if (lines_.size() > k_history) lines_.pop_front();
    }
    void flush_() override {}

    std::deque<LogLine> lines_;
};

std::shared_ptr<HistorySink> history() {
    static auto sink = std::make_shared<HistorySink>();
    return sink;
}
} // namespace

void start_log(bool verbose) {
    auto console = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
    auto logger = std::make_shared<spdlog::logger>("bounce", spdlog::sinks_init_list{console, history()});
    logger->set_pattern("%^[%l]%$ %v");
    logger->set_level(verbose ? spdlog::level::debug : spdlog::level::info);
    spdlog::set_default_logger(logger);
}

std::deque<LogLine> recent_log_lines() {
    return history()->copy();
}

} // namespace bounce
