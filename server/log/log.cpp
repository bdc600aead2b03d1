#include "server/log/log.hpp"

#include <memory>
#include <mutex>
#include <string>

#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace mechane::log {
namespace {

spdlog::level::level_enum to_spdlog(Level level) {
  switch (level) {
    case Level::debug:
      return spdlog::level::debug;
    case Level::info:
      return spdlog::level::info;
    case Level::warning:
      return spdlog::level::warn;
    case Level::error:
      break;
  }
  return spdlog::level::err;
}

/// Keeps the newest warning.
class TroubleSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  TroubleSink() { set_level(spdlog::level::warn); }
  [[nodiscard]] Trouble trouble() {
    const std::lock_guard lock(mutex_);
    return trouble_;
  }

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    ++trouble_.count;
    trouble_.last.assign(message.payload.data(), message.payload.size());
  }
  void flush_() override {}

 private:
  Trouble trouble_;
};

}  // namespace

void start(std::string_view program, Level least) {
  auto logger = spdlog::stderr_color_mt(std::string(program));
  logger->set_level(to_spdlog(least));
  logger->set_pattern("%Y-%m-%d %H:%M:%S.%e %^%-7l%$ %n: %v");
  logger->flush_on(spdlog::level::debug);
  logger->sinks().push_back(std::make_shared<TroubleSink>());
  spdlog::set_default_logger(std::move(logger));
}

void debug(std::string_view text) {
  spdlog::debug(text);
}
void info(std::string_view text) {
  spdlog::info(text);
}
void warning(std::string_view text) {
  spdlog::warn(text);
}
void error(std::string_view text) {
  spdlog::error(text);
}
void error(const Error& e) {
  spdlog::error(e.to_string());
}

Trouble trouble() {
  const auto logger = spdlog::default_logger();
  for (const spdlog::sink_ptr& sink : logger->sinks()) {
    if (auto* keeper = dynamic_cast<TroubleSink*>(sink.get())) return keeper->trouble();
  }
  return {};
}

}  // namespace mechane::log
