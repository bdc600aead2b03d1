// The few operations by which an authoring tool changes a scenario's file. Everything else stays as it was written, to the byte:
// unknown nodes, metadata, comments, order, blanks.
//
//   auto editor = Editor::open("screw.x3d");
//   editor->set("activities/use/steps/fill/hintSeconds", std::vector<double>{30});
//   editor->set_attribute("INNER", "mass", "40");
//   for (const Problem& problem : editor->check(files)) show(problem);
//   editor->save("screw.x3d");
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"
#include "server/scenario/checker.hpp"
#include "server/state/description.hpp"
#include "server/x3d/document.hpp"

namespace mechane::authoring {

/// A path names a place in the metadata, with '/' between sets: "activities/use/steps/fill" within mechane:scenario; or it begins with a
/// node's DEF and one of our sets, "INNER/mechane:haptic/stiffness". One thread.
class Editor {
 public:
  [[nodiscard]] static Expected<Editor> open(const std::filesystem::path& file);
  /// From memory; `path` as in read_document().
  [[nodiscard]] static Expected<Editor> read(std::string_view text, const std::filesystem::path& path);

  [[nodiscard]] const x3d::Document& document() const { return document_; }
  /// The file as it stands now.
  [[nodiscard]] const std::string& text() const { return document_.source(); }

  /// Writes a value; adds it, and the sets around it, where they do not exist. Errors: a path that the schema does not know (with the
  /// nearest name), a value of the wrong kind or out of its range. The file is not changed then.
  [[nodiscard]] Expected<void> set(std::string_view path, const state::Parameter& value);
  /// Adds an empty set, such as a step, after its sibling `after`; empty: as the last one.
  [[nodiscard]] Expected<void> add(std::string_view path, std::string_view after = {});
  /// Moves a set to the place after its sibling `after`; empty: before the other sets around it. Comments before it go with it.
  [[nodiscard]] Expected<void> reorder(std::string_view path, std::string_view after = {});
  /// Removes a value or a set. References to it stay; check() reports them.
  [[nodiscard]] Expected<void> remove(std::string_view path);
  /// Writes a field of the X3D node with that DEF. Errors: no such node, a field that X3D does not have, a faulty value.
  [[nodiscard]] Expected<void> set_attribute(std::string_view def, std::string_view field, std::string_view value);

  /// The problems that `mechane check` finds in the file as it stands now.
  [[nodiscard]] std::vector<x3d::Problem> check(scenario::ObjectLoader& loader) const;
  /// Writes the file: all of it, or nothing.
  [[nodiscard]] Expected<void> save(const std::filesystem::path& file) const;

 private:
  explicit Editor(x3d::Document document) : document_(std::move(document)) {}
  /// Makes a text the file, if it can be read.
  Expected<void> become(const std::string& text);

  x3d::Document document_;
};

/// Writes a text as a file: first as a new file beside it, which then replaces it.
[[nodiscard]] Expected<void> write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace mechane::authoring
