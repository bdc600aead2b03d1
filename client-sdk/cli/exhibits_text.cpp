#include "client-sdk/cli/exhibits_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "client-sdk/cli/columns.hpp"

namespace mechane::cli {
namespace {

std::string title_of(const client::OpenableExhibit& exhibit) {
  const auto english = exhibit.title.find("en");
  if (english != exhibit.title.end()) return english->second;
  return exhibit.title.empty() ? std::string() : exhibit.title.begin()->second;
}

}  // namespace

std::string exhibits_table(const client::ExhibitStatus& status) {
  Columns table({"exhibit", "title", "worlds", "finishing", "content"}, "<<>><");
  for (const client::OpenableExhibit& exhibit : status.exhibits) {
    table.add({exhibit.id, title_of(exhibit), std::to_string(exhibit.worlds), std::to_string(exhibit.former_worlds),
               exhibit.content_hash.substr(0, 8)});
  }
  std::string text = table.text();
  if (!status.preparing.empty()) text += fmt::format("\n{} is being read\n", status.preparing);
  if (!status.loadable.empty()) text += fmt::format("\nnot loaded: {}\n", fmt::join(status.loadable, ", "));
  if (!status.changeable) text += "\nthis server takes no changes: it has no key (--exhibit-key)\n";
  return text;
}

std::string exhibits_json(const client::ExhibitStatus& status) {
  nlohmann::ordered_json exhibits = nlohmann::ordered_json::array();
  for (const client::OpenableExhibit& exhibit : status.exhibits) {
    exhibits.push_back({{"id", exhibit.id},
                        {"title", exhibit.title},
                        {"content_hash", exhibit.content_hash},
                        {"worlds", exhibit.worlds},
                        {"former_worlds", exhibit.former_worlds}});
  }
  const nlohmann::ordered_json json{{"server", status.server},
                                    {"changeable", status.changeable},
                                    {"preparing", status.preparing},
                                    {"exhibits", exhibits},
                                    {"loadable", status.loadable}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace mechane::cli
