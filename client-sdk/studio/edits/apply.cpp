#include "client-sdk/studio/edits/apply.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "client-sdk/authoring/editor.hpp"
#include "client-sdk/authoring/rename.hpp"
#include "client-sdk/studio/edits/body_edits.hpp"
#include "client-sdk/studio/edits/joint_edits.hpp"
#include "client-sdk/studio/edits/meta_edits.hpp"
#include "server/base/suggestion.hpp"
#include "server/x3d/metadata.hpp"

namespace mechane::studio {
namespace {

using authoring::Editor;

const std::set<std::string>& known_names(const authoring::NamesOf& names, NameKind kind) {
  switch (kind) {
    case NameKind::quantity:
      return names.quantities;
    case NameKind::activity:
      return names.activities;
    case NameKind::step:
      return names.steps;
    case NameKind::visit:
      return names.visits;
    case NameKind::effect:
      return names.effects;
    case NameKind::thing:
      break;
  }
  return names.things;
}

std::map<std::string, std::string>& renames_of(authoring::Renames& renames, NameKind kind) {
  switch (kind) {
    case NameKind::quantity:
      return renames.quantities;
    case NameKind::activity:
      return renames.activities;
    case NameKind::step:
      return renames.steps;
    case NameKind::visit:
      return renames.visits;
    case NameKind::effect:
      return renames.effects;
    case NameKind::thing:
      break;
  }
  return renames.things;
}

Expected<std::string> renamed(const x3d::Document& document, const RenameEverywhere& command) {
  const authoring::NamesOf names = authoring::names_of_file(document);
  const std::set<std::string>& known = known_names(names, command.kind);
  if (!known.contains(command.from))
    return fail(ErrorCode::unknown_name, fmt::format("no {} is called '{}'", word_of(command.kind), command.from), "",
                suggest(command.from, std::vector<std::string>(known.begin(), known.end()), "there is none"));
  if (!is_new_name(command.to)) return no_new_name(command.to);
  if (known.contains(command.to))
    return fail(ErrorCode::duplicate, fmt::format("'{}' is taken", command.to), "", "take another name");
  authoring::Renames renames;
  renames_of(renames, command.kind)[command.from] = command.to;
  authoring::TextEdits edits;
  authoring::rename_in(document, renames, edits);
  return edits.apply(document.source());
}

class Applier {
 public:
  Applier(Editor& editor, std::vector<std::string>& added) : editor_(editor), added_(added) {}

  Expected<void> operator()(const SetValue& c) {
    if (auto there = need_own_set(c.path); !there) return there;
    return editor_.set(c.path, c.value);
  }
  Expected<void> operator()(const AddSet& c) {
    if (auto there = need_own_set(c.path); !there) return there;
    return editor_.add(c.path, c.after);
  }
  Expected<void> operator()(const ReorderSet& c) { return editor_.reorder(c.path, c.after); }
  Expected<void> operator()(const RemoveEntry& c) { return editor_.remove(c.path); }
  Expected<void> operator()(const SetField& c) { return editor_.set_attribute(c.node, c.field, c.value); }
  Expected<void> operator()(const RenameEverywhere& c) { return become(renamed(editor_.document(), c)); }
  Expected<void> operator()(const InsertPart& c) { return become(with_part(editor_.document(), c)); }
  Expected<void> operator()(const InsertMesh& c) { return become(with_mesh(editor_.document(), c)); }
  Expected<void> operator()(const DuplicateBody& c) { return become(with_copy(editor_.document(), c)); }
  Expected<void> operator()(const DeleteNode& c) { return become(without_node(editor_.document(), c.node)); }
  Expected<void> operator()(const MoveNode& c) { return become(with_pose(editor_.document(), c)); }
  Expected<void> operator()(const JoinBodies& c) { return become(with_joint(editor_.document(), c)); }
  Expected<void> operator()(const AddView& c) { return become(with_view(editor_.document(), c)); }
  Expected<void> operator()(const SetMeta& c) { return become(with_meta(editor_.document(), c)); }

 private:
  /// The first value in a set of ours on a node makes the set: "WHEEL/mechane:haptic/stiffness".
  Expected<void> need_own_set(const std::string& path) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    const std::string node = path.substr(0, slash);
    const std::string set = path.substr(std::min(slash + 1, path.size()), path.find('/', slash + 1) - slash - 1);
    const bool ours = set == "mechane:haptic" || set == "mechane:body" || set == "mechane:agent";
    const x3d::NodeId owner = editor_.document().find_def(node);
    if (!ours || !owner || x3d::find_set(editor_.document(), owner, set)) return {};
    return become(with_own_set(editor_.document(), node, set));
  }
  Expected<void> become(const Expected<std::string>& text) {
    if (!text) return tl::unexpected(text.error());
    auto next = Editor::read(*text, editor_.document().path());
    if (!next) return tl::unexpected(next.error());
    editor_ = std::move(*next);
    return {};
  }
  Expected<void> become(const Expected<Grown>& grown) {
    if (!grown) return tl::unexpected(grown.error());
    if (auto became = become(Expected<std::string>(grown->text)); !became) return became;
    added_.push_back(grown->name);
    return {};
  }

  Editor& editor_;
  std::vector<std::string>& added_;
};

}  // namespace

tl::expected<Applied, Refused> apply_commands(std::string_view text, const std::filesystem::path& path,
                                              std::span<const Command> commands) {
  auto editor = Editor::read(text, path);
  if (!editor) return tl::unexpected(Refused{0, editor.error()});
  Applied out;
  Applier applier(*editor, out.added);
  for (std::size_t i = 0; i < commands.size(); ++i) {
    if (auto done = std::visit(applier, commands[i]); !done) return tl::unexpected(Refused{i, done.error()});
  }
  out.text = editor->text();
  return out;
}

}  // namespace mechane::studio
