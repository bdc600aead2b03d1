// What authors' pages and scripts send, and what a damaged disk leaves of a draft's history: it is read within limits, or refused with a
// remedy; and commands that are read leave a file that can be read.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "client-sdk/authoring/reference_example.hpp"
#include "client-sdk/studio/draft/journal.hpp"
#include "client-sdk/studio/edits/apply.hpp"
#include "client-sdk/studio/edits/command.hpp"
#include "client-sdk/studio/shelf/catalogue.hpp"
#include "client-sdk/studio/shelf/fold.hpp"
#include "client-sdk/studio/shelf/records.hpp"
#include "server/x3d/document.hpp"

namespace {

using namespace mechane;

void must_hold(bool held) {
  if (!held) std::abort();
}

/// What is moved is neither changed nor lost.
void look_at_move(const studio::Command& command) {
  std::string text = authoring::reference_example();
  auto moved = studio::apply_commands(text, "fuzz.x3d", {&command, 1});
  if (!moved) return;
  std::ranges::sort(text);
  std::ranges::sort(moved->text);
  must_hold(moved->text == text);
}

void look_at(const studio::CommandList& list) {
  must_hold(list.revision >= 0 && !list.commands.empty() && list.commands.size() <= studio::kMostCommands);
  for (const studio::Command& command : list.commands) {
    must_hold(studio::title_of(command).size() <= 100);
    if (const auto* move = std::get_if<studio::MoveNode>(&command))
      must_hold(move->X_WB.p.allFinite() && std::abs(move->X_WB.R.norm() - 1) < 1e-6);
    if (const auto* join = std::get_if<studio::JoinBodies>(&command))
      must_hold(join->p_WA.allFinite() && std::abs(join->axis_W.norm() - 1) < 1e-6);
    if (const auto* view = std::get_if<studio::AddView>(&command))
      must_hold(view->field_of_view_rad >= 0 && view->field_of_view_rad < 3.1416);
  }
  for (const studio::Command& command : list.commands)
    if (std::holds_alternative<studio::ReorderSet>(command)) look_at_move(command);
  const auto applied = studio::apply_commands(authoring::reference_example(), "fuzz.x3d", list.commands);
  if (!applied) return must_hold(applied.error().command < list.commands.size());
  x3d::Problems problems("");
  must_hold(x3d::read_document(applied->text, "fuzz.x3d", problems).has_value());
}

/// What is read is written so that it is read again, and is found by its own words.
void look_at(const studio::RecordMap& records) {
  const auto again = studio::parse_records(studio::records_json(records));
  must_hold(again && *again == records);
  for (const auto& [path, record] : records) {
    const studio::CatalogueItem item{.kind = studio::ItemKind::mesh, .name = path, .path = path, .about = record};
    must_hold(studio::fits(item, {.text = record.description}));
    for (const std::string& tag : record.tags)
      must_hold(studio::fits(item, {.kind = "mesh", .tag = tag}));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto journal = studio::parse_journal(text)) {
    must_hold(journal->whole_bytes <= size && journal->revision >= 0);
    for (std::size_t i = 0; i < journal->lines.size(); ++i)
      must_hold(journal->lines[i].revision == journal->revision + static_cast<std::int64_t>(i) + 1);
  }
  must_hold(studio::folded(studio::folded(text)) == studio::folded(text));
  if (const auto records = studio::parse_records(text)) look_at(*records);
  const auto about = studio::parse_about(text);
  must_hold(about || !about.error().remedy.empty());
  if (about) look_at({{about->path, about->about}});
  const auto list = studio::parse_command_list(text);
  if (list)
    look_at(*list);
  else
    must_hold(!list.error().remedy.empty());
  return 0;
}
