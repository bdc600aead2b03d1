// A draft's files, and what goes out and comes in with them: archives, and other exhibits.
#include <algorithm>

#include <fmt/format.h>

#include "client-sdk/studio/draft/addition.hpp"
#include "client-sdk/studio/draft/bundle.hpp"
#include "client-sdk/studio/shelf/shelf.hpp"
#include "client-sdk/studio/shelf/shelf_text.hpp"
#include "server/base/whole_file.hpp"
#include "server/content/mesh_import.hpp"
#include "server/scenario/solid.hpp"

namespace mechane::studio {
namespace {

namespace fs = std::filesystem;

/// Of a mesh file, that are told.
constexpr std::size_t kMostNodes = 200;
/// Where an archive is unpacked; a draft cannot have this name.
constexpr std::string_view kIncoming = ".incoming";
constexpr std::string_view kFromDraft = "draft:";

/// By its head, which tells its length.
bool is_webp(std::string_view bytes) {
  constexpr std::size_t kHead = 12;
  if (bytes.size() < kHead || !bytes.starts_with("RIFF") || bytes.substr(8, 4) != "WEBP") return false;
  std::uint32_t length = 0;
  for (std::size_t i = 0; i < 4; ++i)
    length |= std::uint32_t{static_cast<unsigned char>(bytes[4 + i])} << (8 * i);
  return length == bytes.size() - 8;
}

ShelfJson json_of(const std::vector<authoring::MergeNote>& notes) {
  ShelfJson list = ShelfJson::array();
  for (const authoring::MergeNote& note : notes)
    list.push_back({{"what", note.what},
                    {"theirs", note.theirs},
                    {"here", note.ours},
                    {"renamed", note.kind == authoring::MergeNote::Kind::renamed}});
  return list;
}

}  // namespace

ShelfResult<std::string> Shelf::files(const std::string& name) {
  if (const auto opened = open(name); !opened) return tl::unexpected(opened.error());
  auto uses = all_uses();
  ShelfJson list = ShelfJson::array();
  for (const DraftFile& file : files_of(name).all()) {
    const std::string url = fmt::format("{}/{}", kFilesFolder, file.name);
    list.push_back({{"name", file.name},
                    {"url", url},
                    {"kind", file.sound ? "sound" : "mesh"},
                    {"bytes", file.bytes},
                    {"published", file.published},
                    {"uses", json_of(uses[fmt::format("{}/{}", name, url)])}});
  }
  return shelf_text({{"files", std::move(list)}});
}

ShelfResult<std::string> Shelf::add_file(const std::string& name, const std::string& file,
                                         std::span<const std::byte> bytes, bool replace) {
  auto opened = open(name);
  if (!opened) return tl::unexpected(opened.error());
  if (auto put = files_of(name).put(file, bytes, replace); !put) return shelf_fault(put.error());
  (*opened)->checked = -1;
  return files(name);
}

ShelfResult<std::string> Shelf::remove_file(const std::string& name, const std::string& file) {
  auto opened = open(name);
  if (!opened) return tl::unexpected(opened.error());
  // What cannot be read may use it.
  if (const auto text = document_of(name, false); !text && text.error().error.code != ErrorCode::not_found)
    return tl::unexpected(text.error());
  const std::string path = fmt::format("{}/{}/{}", name, kFilesFolder, file);
  if (std::vector<FileUse> uses = all_uses()[path]; !uses.empty()) {
    const FileUse& first = uses.front();
    ShelfFault used{{ErrorCode::conflict,
                     fmt::format("{} is used by {} in {} {}", file, first.place,
                                 first.draft ? "the draft of" : "the published exhibit", first.exhibit),
                     "", "remove what uses it, and publish the drafts that had it"}};
    used.uses = std::move(uses);
    return tl::unexpected(std::move(used));
  }
  if (auto removed = files_of(name).remove(file); !removed) return shelf_fault(removed.error());
  (void)records_.put({{path, {}}});  // where it cannot be written, the catalogue tells why
  (*opened)->checked = -1;
  return files(name);
}

ShelfResult<x3d::Document> Shelf::document_of(const std::string& name, bool drafted) {
  if (!is_exhibit_name(name)) return bad_exhibit_name();
  const auto opened = drafted ? open(name) : ShelfResult<Open*>(nullptr);
  if (!opened) return tl::unexpected(opened.error());
  const auto bytes = drafted ? std::vector<std::byte>() : read_whole(exhibit_file(name), Draft::kMostBytes);
  if (!bytes && bytes.error().code == ErrorCode::not_found)
    return shelf_fault({ErrorCode::not_found, "there is no such exhibit", name, "take one of the list"});
  if (!bytes) return shelf_fault(bytes.error());
  x3d::Problems problems(name);
  auto read = x3d::read_document(drafted ? (*opened)->draft.text() : as_text(*bytes), exhibit_file(name), problems);
  if (!read) return shelf_fault(read.error());
  return std::move(*read);
}

fs::path Shelf::file_at(const std::string& name, bool drafted, const std::string& path) const {
  if (fs::path own = drafted ? own_file(state_ / name, path) : fs::path(); !own.empty()) return own;
  const fs::path itself = exhibit_file(name).lexically_normal();
  fs::path file = (itself.parent_path() / path).lexically_normal();
  const fs::path below = file.lexically_relative(scenarios_.lexically_normal());
  std::error_code unknown;
  const bool here = !below.empty() && *below.begin() != ".." && file != itself && fs::is_regular_file(file, unknown);
  return here ? file : fs::path();
}

ShelfResult<std::string> Shelf::pack(const std::string& name) {
  const bool drafted = std::ranges::binary_search(draft_names(), name);
  const auto text = document_of(name, drafted);
  if (!text) return tl::unexpected(text.error());
  const Bundle whole = bundle(*text, {[&](const std::string& path) { return file_at(name, drafted, path); }});
  auto bytes = write_archive(name, whole.text, whole.files);
  if (!bytes) return shelf_fault(bytes.error());
  return std::move(*bytes);
}

Expected<void> Shelf::unpack_to(const fs::path& folder, const std::string& name, std::span<const std::byte> archive,
                                const Author& author) const {
  const DraftFiles files(folder, exhibit_file(name).parent_path());
  const auto exhibit = read_archive(archive, [&](const std::string& file, std::span<const std::byte> bytes) {
    return files.put(file, bytes, false);
  });
  if (!exhibit) return tl::unexpected(exhibit.error());
  auto text = text_named(exhibit->text, exhibit->name, name, exhibit_file(name));
  if (!text) return tl::unexpected(text.error());
  const auto made = Draft::make(folder, std::move(*text), "file:" + exhibit->name, author);
  return made ? Expected<void>() : tl::unexpected(made.error());
}

ShelfResult<std::string> Shelf::unpack(const std::string& name, std::span<const std::byte> archive,
                                       const Author& author) {
  if (!is_exhibit_name(name)) return bad_exhibit_name();
  if (auto place = need_place(name, false); !place) return tl::unexpected(place.error());
  const fs::path folder = state_ / kIncoming;
  std::error_code error, ignored;
  fs::remove_all(folder, ignored);  // of a program that was ended meanwhile
  auto unpacked = unpack_to(folder, name, archive, author);
  if (unpacked) fs::rename(folder, state_ / name, error);
  if (error) unpacked = tl::unexpected(file_error("cannot be made", state_ / name, error.value()));
  if (!unpacked) {
    fs::remove_all(folder, ignored);
    return shelf_fault(unpacked.error());
  }
  (void)flush_to_disk(state_);
  return view(name);
}

ShelfResult<std::string> Shelf::merge(const std::string& name, std::int64_t revision, const std::string& from,
                                      const Author& author) {
  auto opened = open_at(name, revision);
  if (!opened) return tl::unexpected(opened.error());
  const bool drafted = from.starts_with(kFromDraft);
  if (!drafted && !from.starts_with(kFromExhibit))
    return shelf_fault({ErrorCode::invalid_value, "the request does not say what to add to the draft", from,
                        "write exhibit:NAME for what is published, or draft:NAME"});
  const std::string other = from.substr(from.find(':') + 1);
  if (other == name)
    return shelf_fault({ErrorCode::invalid_value, "an exhibit is not added to itself", from,
                        "duplicate its bodies, or make a copy of it under another name first"});
  const auto ours = document_of(name, true), theirs = document_of(other, drafted);
  if (!ours || !theirs) return tl::unexpected((ours ? theirs : ours).error());
  const DraftFiles files = files_of(name);
  const auto added =
      addition_of(*ours, *theirs, files, [&](const std::string& path) { return file_at(other, drafted, path); });
  if (!added) return shelf_fault(added.error());
  const auto step = [&] { return (*opened)->draft.step("add " + other, added->text, author); };
  if (auto done = put_files(files, added->files, step); !done) return shelf_fault(done.error());
  std::map<std::string, std::string> copied;
  for (const ArchiveSource& source : added->files)
    copied[source.name] = fmt::format("{}/{}/{}", other, kFilesFolder, source.path.filename().string());
  copy_records(name, copied);
  auto view = view_of(name, **opened);
  if (!view) return view;
  ShelfJson answer = ShelfJson::parse(*view);
  answer["merged"] = json_of(added->notes);
  return shelf_text(answer);
}

Expected<std::vector<std::byte>> Shelf::picture_bytes(const std::string& name) const {
  auto own = read_whole(state_ / name / kPictureFile, kMostPictureBytes);
  return own ? own : read_whole(exhibit_file(name).parent_path() / kPictureFile, kMostPictureBytes);
}

ShelfResult<std::string> Shelf::picture(const std::string& name) const {
  if (!is_exhibit_name(name)) return bad_exhibit_name();
  const auto bytes = picture_bytes(name);
  if (!bytes) return shelf_fault({ErrorCode::not_found, "there is no picture of this exhibit", name, "open it once"});
  return std::string(as_text(*bytes));
}

ShelfResult<std::string> Shelf::set_picture(const std::string& name, std::span<const std::byte> webp) {
  if (const auto opened = open(name); !opened) return tl::unexpected(opened.error());
  if (!is_webp(as_text(webp)))
    return shelf_fault({ErrorCode::invalid_value, "this is not a WebP picture", name, "send one, of 64 KiB at most"});
  if (auto written = write_whole(state_ / name / kPictureFile, webp, WholeFile::durable); !written)
    return shelf_fault(written.error());
  return shelf_text({{"kept", true}});
}

ShelfResult<std::string> Shelf::nodes_of_file(const std::string& name, const std::string& file) {
  auto opened = open(name);
  if (!opened) return tl::unexpected(opened.error());
  const auto path = files_of(name).find(file);
  if (!path) return shelf_fault(path.error());
  const auto scene = content::import_mesh(*path);
  if (!scene) return shelf_fault(scene.error());
  ShelfJson nodes = ShelfJson::array();
  for (const content::ImportedNode& node : scene->nodes) {
    if (node.name.empty() || nodes.size() >= kMostNodes) continue;
    const auto parts = content::collision_parts(*scene, node.name);
    if (!parts) continue;
    const scenario::Solid solid = scenario::solid_of(*parts);
    nodes.push_back({{"name", node.name}, {"volume", solid.is_closed() ? ShelfJson(solid.volume_m3) : ShelfJson()}});
  }
  return shelf_text({{"nodes", std::move(nodes)}});
}

}  // namespace mechane::studio
