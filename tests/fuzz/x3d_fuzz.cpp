// Any bytes as a scenario file: read, compiled, checked. Mesh files are not there, so that nothing but the bytes decides.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "server/base/assert.hpp"
#include "server/scenario/compiler.hpp"

namespace {

class NoFiles final : public mechane::scenario::ObjectLoader {
 public:
  mechane::Expected<std::shared_ptr<const mechane::collision::Object>> load(const std::filesystem::path&,
                                                                            const std::string&) override {
    return nullptr;
  }
  mechane::Expected<std::string> content_hash(const std::filesystem::path&) override { return std::string(32, '0'); }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace scenario = mechane::scenario;
  scenario::Problems problems("fuzz.x3d");
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto document = scenario::read_document(bytes, "fuzz.x3d", problems);
  MECHANE_ASSERT(document.has_value() || problems.has_errors());
  if (document) {
    NoFiles files;
    const auto world = scenario::compile(*document, files, problems);
    MECHANE_ASSERT(world.has_value() != problems.has_errors());
  }
  static_cast<void>(scenario::to_json(problems.all()));
  return 0;
}
