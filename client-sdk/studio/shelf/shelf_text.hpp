// JSON of the shelf and its catalogue. For the .cpp files of this room only.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "client-sdk/studio/shelf/records.hpp"
#include "client-sdk/studio/shelf/shelf_fault.hpp"

namespace mechane::studio {

using ShelfJson = nlohmann::json;

/// What a draft begins as, before the exhibit's name.
inline constexpr std::string_view kFromExhibit = "exhibit:";

/// Of an exhibit or its draft, in its folder.
inline constexpr std::string_view kPictureFile = "picture.webp";

[[nodiscard]] inline std::string shelf_text(const ShelfJson& json) {
  return json.dump(-1, ' ', false, ShelfJson::error_handler_t::replace);
}

[[nodiscard]] inline tl::unexpected<ShelfFault> shelf_fault(Error error) {
  return tl::unexpected(ShelfFault{std::move(error)});
}

[[nodiscard]] inline tl::unexpected<ShelfFault> bad_exhibit_name() {
  return shelf_fault({ErrorCode::invalid_value, "this cannot be an exhibit's name", "",
                      "take 1 to 31 of the letters a-z, digits and '-', with a letter or digit first"});
}

[[nodiscard]] inline ShelfJson json_of(const std::vector<FileUse>& uses) {
  ShelfJson list = ShelfJson::array();
  for (const FileUse& use : uses)
    list.push_back({{"place", use.place}, {"line", use.line}, {"exhibit", use.exhibit}, {"draft", use.draft}});
  return list;
}
[[nodiscard]] ShelfJson json_of(const Record& record);

/// As an exhibit of another name than it had: a server cannot have two with one id.
[[nodiscard]] Expected<std::string> text_named(std::string_view text, const std::string& was, const std::string& name,
                                               const std::filesystem::path& file);

}  // namespace mechane::studio
