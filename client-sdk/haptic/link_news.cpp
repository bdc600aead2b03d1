#include "client-sdk/haptic/link_news.hpp"

#include <fmt/format.h>

namespace mechane::haptic {

using client::LinkState;

LinkNews::LinkNews(const client::ClientConfig& config)
    : hand_(fmt::format("hand {} of {}", config.user, config.kiosk)),
      domain_(fmt::format("DDS domain {}", config.domain)) {}

std::optional<LinkNews::Line> LinkNews::look(LinkState state, const std::string& refusal, TimePoint now) {
  const bool same = state == state_ && refusal == refusal_;
  if (same && state == LinkState::searching && !warned_ && now - since_ >= kPatience) {
    warned_ = true;
    return Line{
        log::Level::warning,
        fmt::format("no server answers in {}: start one, or correct --domain or CYCLONEDDS_URI ('mechane doctor' "
                    "finds what is wrong on this machine)",
                    domain_)};
  }
  if (same) return {};
  state_ = state;
  refusal_ = refusal;
  since_ = now;
  switch (state) {
    case LinkState::searching:
      return Line{log::Level::info, "looking for a server in " + domain_};
    case LinkState::joined:
      return Line{log::Level::info, hand_ + " is in a world of the server"};
    case LinkState::refused:
      return Line{log::Level::warning, refusal};
    case LinkState::lost:
      return Line{log::Level::warning, "the server is silent: no force until it is back, which is waited for"};
  }
  return {};
}

}  // namespace mechane::haptic
