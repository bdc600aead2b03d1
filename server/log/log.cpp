#include "server/log/log.hpp"

#include <string>

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

}  // namespace

void start(std::string_view program, Level least) {
  auto logger = spdlog::stderr_color_mt(std::string(program));
  logger->set_level(to_spdlog(least));
  logger->set_pattern("%Y-%m-%d %H:%M:%S.%e %^%-7l%$ %n: %v");
  logger->flush_on(spdlog::level::debug);
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

}  // namespace mechane::log
