// An exhibit's archive from anywhere: it is refused with what, and what to do, before more comes out of it than a draft may have; or its
// names are those that a draft takes, each once, and what was read is written and read again to the same bytes.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <span>
#include <string>

#include "client-sdk/studio/draft/archive.hpp"
#include "client-sdk/studio/draft/draft.hpp"
#include "client-sdk/studio/draft/draft_files.hpp"

namespace {

using namespace mechane;

void must_hold(bool held) {
  if (!held) std::abort();
}

void look_at(const studio::ArchivedExhibit& exhibit) {
  must_hold(studio::is_exhibit_name(exhibit.name) && exhibit.text.size() <= studio::Draft::kMostBytes);
  const auto bytes = studio::write_archive(exhibit.name, exhibit.text, {});
  must_hold(bytes.has_value());
  const auto again =
      studio::read_archive(std::as_bytes(std::span(*bytes)),
                           [](const std::string&, std::span<const std::byte>) { return Expected<void>(); });
  must_hold(again.has_value() && again->name == exhibit.name && again->text == exhibit.text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::set<std::string> names;
  std::size_t together = 0;
  const auto exhibit =
      studio::read_archive(std::as_bytes(std::span(data, size)),
                           [&](const std::string& name, std::span<const std::byte> bytes) -> Expected<void> {
                             must_hold(studio::is_file_name(name) && names.insert(name).second);
                             must_hold(bytes.size() <= studio::DraftFiles::kMostBytes);
                             together += bytes.size();
                             return {};
                           });
  must_hold(names.size() <= studio::DraftFiles::kMostFiles && together <= studio::DraftFiles::kMostOfAll);
  if (exhibit)
    look_at(*exhibit);
  else
    must_hold(!exhibit.error().what.empty() && !exhibit.error().remedy.empty());
  return 0;
}
