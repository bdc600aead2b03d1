#include "client-sdk/visit/device_number.hpp"

#include <array>
#include <utility>

namespace mechane::visit {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kNouns{{{"The handle", "Handle"},
                                                                               {"the handle", "handle"},
                                                                               {"The glove", "Glove"},
                                                                               {"the glove", "glove"},
                                                                               {"Η λαβή", "Η λαβή"},
                                                                               {"τη λαβή", "τη λαβή"},
                                                                               {"Το γάντι", "Το γάντι"},
                                                                               {"το γάντι", "το γάντι"}}};

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
