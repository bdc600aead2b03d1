// Any bytes as a scenario file: read, compiled, checked; and, where they are X3D, edited and merged with themselves. Mesh files are not
// read, so that only the bytes decide.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "client-sdk/authoring/editor.hpp"
#include "client-sdk/authoring/rename.hpp"
#include "server/base/assert.hpp"
#include "server/scenario/compiler.hpp"
#include "server/x3d/document.hpp"

namespace authoring = mechane::authoring;
namespace scenario = mechane::scenario;
namespace x3d = mechane::x3d;

namespace {

class NoFiles final : public scenario::ObjectLoader {
 public:
  mechane::Expected<std::shared_ptr<const mechane::collision::Object>> load(
      const std::filesystem::path&, const std::string&, const mechane::geometry::SolidChoice&) override {
    return nullptr;
  }
  mechane::Expected<std::optional<scenario::Solid>> solid(const std::filesystem::path&, const std::string&) override {
    return std::nullopt;
  }
  mechane::Expected<std::string> content_hash(const std::filesystem::path&) override { return std::string(32, '0'); }
};

/// Every edit gives a file that can be read, or an error. Reading alone changes nothing.
void edit(const x3d::Document& document) {
  auto editor = authoring::Editor::read(document.source(), "fuzz.x3d");
  MECHANE_ASSERT(editor.has_value() && editor->text() == document.source());
  static_cast<void>(editor->set("activities/use/steps/turn/hintSeconds", std::vector<double>{3}));
  static_cast<void>(editor->add("activities/use/steps/more", "turn"));
  static_cast<void>(editor->set_attribute("INNER", "mass", "3"));
  static_cast<void>(editor->remove("activities/use/steps/turn"));
  const authoring::NamesOf names = authoring::names_of_file(document);
  authoring::TextEdits edits;
  authoring::rename_in(document, authoring::renames_for(names, names), edits);
  static_cast<void>(authoring::Editor::read(edits.apply(document.source()), "fuzz.x3d"));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  x3d::Problems problems("fuzz.x3d");
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto document = x3d::read_document(bytes, "fuzz.x3d", problems);
  MECHANE_ASSERT(document.has_value() || problems.has_errors());
  MECHANE_ASSERT(document.has_value() || !document.error().remedy.empty());
  if (document) {
    NoFiles files;
    const auto world = scenario::compile(*document, files, problems);
    MECHANE_ASSERT(world.has_value() != problems.has_errors());
    edit(*document);
  }
  static_cast<void>(x3d::to_json(problems.all()));
  return 0;
}
