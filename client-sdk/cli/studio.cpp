#include "client-sdk/cli/studio.hpp"

#include <filesystem>
#include <istream>
#include <optional>
#include <ostream>

#include <nlohmann/json.hpp>

#include "client-sdk/authoring/editor.hpp"
#include "client-sdk/studio/draft/bundle.hpp"
#include "client-sdk/studio/draft/draft_files.hpp"
#include "client-sdk/studio/draft/history.hpp"
#include "client-sdk/studio/edits/apply.hpp"
#include "client-sdk/studio/shelf/shelf.hpp"
#include "client-sdk/studio/view/schema_json.hpp"
#include "client-sdk/studio/view/view.hpp"
#include "server/scenario/checker.hpp"
#include "server/scenario/file_finder.hpp"

namespace mechane::cli {
namespace {

using StudioJson = nlohmann::json;
namespace fs = std::filesystem;
using studio::Move;

std::string studio_line(const StudioJson& json) {
  return json.dump(-1, ' ', false, StudioJson::error_handler_t::replace);
}

/// A file in memory, with what was done to it.
class ScriptedFile {
 public:
  ScriptedFile(std::string file, std::string text) : file_(std::move(file)), history_(std::move(text)) {}

  [[nodiscard]] bool all_done() const { return all_done_; }

  std::string answer(const std::string& line) {
    const Expected<std::string> done = ask(line);
    if (done) return *done;
    all_done_ = false;
    studio::ShelfFault fault{done.error()};
    fault.command = command_;
    return studio::fault_json(fault);
  }

 private:
  Expected<std::string> ask(const std::string& line) {
    command_.reset();
    const StudioJson json =
        line.size() > studio::kMostCommandBytes ? StudioJson() : StudioJson::parse(line, nullptr, false);
    if (json.is_object() && json.contains("op")) {
      auto command = studio::parse_command(line);
      if (!command) return tl::unexpected(command.error());
      return change({std::move(*command)});
    }
    if (json.is_object() && json.contains("do")) {
      const auto verb = studio::parse_stated(line, "do", 20);
      if (!verb) return tl::unexpected(verb.error());
      return perform(*verb);
    }
    auto list = studio::parse_command_list(line);
    if (!list) return tl::unexpected(list.error());
    if (list->revision != history_.revision())
      return fail(ErrorCode::conflict, "the file has another revision", "",
                  "write the revision " + std::to_string(history_.revision()));
    return change(list->commands);
  }

  Expected<std::string> change(const std::vector<studio::Command>& commands) {
    auto applied = studio::apply_commands(history_.text(), file_, commands);
    if (!applied) {
      command_ = applied.error().command;
      return tl::unexpected(applied.error().error);
    }
    if (applied->text != history_.text())
      make({Move::Kind::step,
            {studio::title_of(commands), "", 0, studio::delta_between(history_.text(), applied->text)}});
    return done({{"added", applied->added}});
  }

  Expected<std::string> perform(const std::string& verb) {
    if (verb == "undo" || verb == "redo") {
      if (!make({verb == "undo" ? Move::Kind::undo : Move::Kind::redo, {}}))
        return fail(ErrorCode::conflict, "there is nothing to " + verb, "", "go on");
      return done({});
    }
    if (verb == "save") {
      if (auto written = authoring::write_file(file_, history_.text()); !written)
        return tl::unexpected(written.error());
      return done({{"saved", file_}});
    }
    if (verb == "export") return exported();
    if (verb == "text") return done({{"text", history_.text()}});
    if (verb == "schema") return studio::schema_json();
    if (verb == "view" || verb == "check") return look(verb == "view");
    return fail(ErrorCode::unknown_name, "this request is not known: " + verb.substr(0, 20), "do",
                "write undo, redo, view, check, text, schema, save or export");
  }

  /// FILE.zip beside the file, with the meshes and sounds that it names.
  Expected<std::string> exported() {
    const fs::path file = file_, folder = file.parent_path();
    const std::string name = file.stem().string();
    if (!studio::is_exhibit_name(name))
      return fail(ErrorCode::invalid_value, "an exhibit cannot have this file's name", file_,
                  "rename it to 1 to 31 of the letters a-z, digits and '-'");
    x3d::Problems problems(file_);
    const auto document = x3d::read_document(history_.text(), file_, problems);
    if (!document) return tl::unexpected(document.error());
    const studio::Bundle whole = studio::bundle(*document, {[&](const std::string& path) {
      std::error_code unknown;
      const fs::path named = (folder / path).lexically_normal();
      const bool other = !fs::equivalent(named, file, unknown);
      return other && fs::is_regular_file(named, unknown) ? named : fs::path();
    }});
    const auto bytes = studio::write_archive(name, whole.text, whole.files);
    if (!bytes) return tl::unexpected(bytes.error());
    const fs::path archive = folder / (name + ".zip");
    if (auto written = authoring::write_file(archive, *bytes); !written) return tl::unexpected(written.error());
    return done({{"exported", archive.string()}});
  }

  Expected<std::string> look(bool at_all) {
    x3d::Problems problems(file_);
    const auto document = x3d::read_document(history_.text(), file_, problems);
    if (!document) return tl::unexpected(document.error());
    scenario::FileFinder finder;
    const auto found = scenario::check_text(history_.text(), file_, finder);
    if (!at_all) return done({{"problems", StudioJson::parse(studio::problems_json(&*document, found))}});
    const std::string name = std::filesystem::path(file_).stem().string();
    return studio::view_json({name, history_, *document, "", "", found, {}});
  }

  bool make(const Move& move) {
    auto text = history_.text_after(move);
    if (text) history_.make(move, std::move(*text));
    return text.has_value();
  }

  [[nodiscard]] std::string done(StudioJson more) const {
    if (more.is_null()) more = StudioJson::object();
    more["revision"] = history_.revision();
    return studio_line(more);
  }

  const std::string file_;
  studio::History history_;
  std::optional<std::size_t> command_;  ///< that was refused
  bool all_done_ = true;
};

}  // namespace

int run_studio(const std::string& file, std::istream& in, std::ostream& out, std::ostream& errors) {
  const auto editor = authoring::Editor::open(file);
  if (!editor) {
    errors << "mechane studio: " << editor.error().to_string() << "\n";
    return 2;
  }
  ScriptedFile scripted(file, editor->text());
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) out << scripted.answer(line) << "\n" << std::flush;
  return scripted.all_done() ? 0 : 1;
}

}  // namespace mechane::cli
