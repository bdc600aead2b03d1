// Texts by language on the wire.
#pragma once

#include <vector>

#include "server/state/description.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::transport {

/// Texts by language as wire texts; the map must outlive them.
[[nodiscard]] inline std::vector<proto::WireText> wire_texts(const state::Texts& texts) {
  std::vector<proto::WireText> wire;
  for (const auto& [language, text] : texts) {
    proto::WireText& one = wire.emplace_back();
    proto::set_text(one.language, language);
    one.content = proto::look_into(text);
  }
  return wire;
}

}  // namespace mechane::transport
