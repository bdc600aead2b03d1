#include "server/log/log.hpp"

#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/dist_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "server/log/printable.hpp"
#include "server/log/repeats.hpp"

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

/// Counts all warnings and errors, repeated ones too, and keeps the text of the newest.
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

/// Shows a warning that comes again once a minute. How many more there were is shown after the minute, with the next message of any kind,
/// or at the end of the program.
class RepeatLimitSink final : public spdlog::sinks::dist_sink<std::mutex> {
 public:
  using dist_sink::dist_sink;
  RepeatLimitSink(const RepeatLimitSink&) = delete;
  RepeatLimitSink& operator=(const RepeatLimitSink&) = delete;
  ~RepeatLimitSink() override { tell(repeats_.take_all()); }

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    const auto now = std::chrono::steady_clock::now();
    program_.assign(message.logger_name.data(), message.logger_name.size());
    tell(repeats_.take_over(now));
    const std::string_view text(message.payload.data(), message.payload.size());
    if (message.level < spdlog::level::warn || repeats_.pass(text, message.level, now)) dist_sink::sink_it_(message);
  }

 private:
  void tell(const std::vector<Repeats::Counted>& counted) {
    for (const Repeats::Counted& c : counted) {
      const std::string often = c.repeats == 1 ? "once" : fmt::format("{} times", c.repeats);
      const std::string text = fmt::format("{} (again {} within {} s)", c.text, often, Repeats::kWindow.count());
      dist_sink::sink_it_({program_, static_cast<spdlog::level::level_enum>(c.level), text});
    }
  }

  Repeats repeats_;
  std::string program_;
};

}  // namespace

void start(std::string_view program, Level least) {
  const auto terminal = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
  const auto limited = std::make_shared<RepeatLimitSink>(std::vector<spdlog::sink_ptr>{terminal});
  auto logger = std::make_shared<spdlog::logger>(std::string(program),
                                                 spdlog::sinks_init_list{limited, std::make_shared<TroubleSink>()});
  logger->set_level(to_spdlog(least));
  logger->set_pattern("%Y-%m-%d %H:%M:%S.%e %^%-7l%$ %n: %v");
  logger->flush_on(spdlog::level::debug);
  spdlog::set_default_logger(std::move(logger));
}

void debug(std::string_view text) {
  spdlog::debug(printable(text));
}
void info(std::string_view text) {
  spdlog::info(printable(text));
}
void warning(std::string_view text) {
  spdlog::warn(printable(text));
}
void error(std::string_view text) {
  spdlog::error(printable(text));
}
void error(const Error& e) {
  error(e.to_string());
}

Trouble trouble() {
  const auto logger = spdlog::default_logger();
  for (const spdlog::sink_ptr& sink : logger->sinks()) {
    if (auto* keeper = dynamic_cast<TroubleSink*>(sink.get())) return keeper->trouble();
  }
  return {};
}

}  // namespace mechane::log
