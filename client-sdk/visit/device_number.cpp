#include "client-sdk/visit/device_number.hpp"

#include <array>
#include <utility>

namespace mechane::visit {
namespace {

/// A noun as it stands in the sentences, and as it stands before a number.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kNouns{{{"The handle", "Handle"},
                                                                               {"the handle", "handle"},
                                                                               {"The glove", "Glove"},
                                                                               {"the glove", "glove"},
                                                                               {"λαβή", "λαβή"},
                                                                               {"γάντι", "γάντι"}}};

}  // namespace

std::string by_number(std::string_view sentence, const client::DeviceReport& device) {
  std::string said(sentence);
  for (const auto& [noun, with_number] : kNouns) {
    const std::size_t at = said.find(noun);
    if (at == std::string::npos) continue;
    said.replace(at, noun.size(), std::string(with_number) + " " + std::to_string(device.user + 1));
    break;
  }
  return said;
}

}  // namespace mechane::visit
