#include "client-sdk/gateway/browsers/hand_finders.hpp"

#include <array>
#include <fstream>
#include <string_view>

namespace mechane::gateway {

Expected<void> check_hand_model(const std::filesystem::path& file) {
  std::array<char, 4> head{};
  std::ifstream in(file, std::ios::binary);
  if (!in.read(head.data(), head.size()))
    return fail(ErrorCode::io_failure, "the model of hands cannot be read", file.string(),
                "name the file hand_landmarker.task with --hand-model, readable by the gateway's user");
  if (std::string_view(head.data(), head.size()) != "PK\3\4")
    return fail(ErrorCode::damaged, "this is not a bundle of MediaPipe's hand landmarker", file.string(),
                "download hand_landmarker.task again, and name it with --hand-model");
  return {};
}

}  // namespace mechane::gateway
