#include "client-sdk/studio/draft/archive.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <sys/stat.h>
#include <zip.h>

#include "client-sdk/studio/draft/draft.hpp"
#include "client-sdk/studio/draft/draft_files.hpp"
#include "server/base/utf8.hpp"
#include "server/base/whole_file.hpp"

namespace mechane::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostEntries = DraftFiles::kMostFiles + 10;  ///< with the text and the folders
constexpr zip_uint16_t kFirstDosDay = (1U << 5U) | 1U;             ///< 1980-01-01

struct ZipEnds {
  void operator()(zip_t* zip) const { zip_discard(zip); }
  void operator()(zip_source_t* source) const { zip_source_free(source); }
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using Zip = std::unique_ptr<zip_t, ZipEnds>;
using ZipSource = std::unique_ptr<zip_source_t, ZipEnds>;
using ZipFile = std::unique_ptr<zip_file_t, ZipEnds>;

/// A name from anywhere, for people.
std::string shown_name(std::string_view name) {
  std::string plain = without_controls(utf8_beginning(name, 120));
  return plain.size() < name.size() ? plain + "..." : plain;
}

tl::unexpected<Error> no_archive() {
  return fail(ErrorCode::invalid_value, "this is not a zip archive, or it is damaged or cut short", "",
              "export the exhibit again, and copy all of the file");
}

tl::unexpected<Error> strange_entry(std::string_view name) {
  return fail(ErrorCode::invalid_value, "an exhibit does not have such a file", shown_name(name),
              "pack NAME/NAME.x3d, and meshes and sounds as NAME/files/FILE, and nothing else");
}

tl::unexpected<Error> too_much() {
  return fail(ErrorCode::too_large, "the exhibit has more than 200 files, or more than 512 MiB", "",
              "leave out what is not used, or make meshes smaller");
}

/// An entry that is read.
struct Item {
  zip_uint64_t index = 0;
  std::string entry;  ///< "crane/files/arm.glb"
  std::string name;   ///< "arm.glb"
  std::uintmax_t bytes = 0;
};

/// What an archive holds, as its list of entries tells it.
class Contents {
 public:
  Expected<void> add(zip_t* zip, zip_uint64_t index) {
    zip_stat_t stat{};
    if (zip_stat_index(zip, index, 0, &stat) != 0 || (stat.valid & ZIP_STAT_NAME) == 0 ||
        (stat.valid & ZIP_STAT_SIZE) == 0)
      return no_archive();
    const std::string_view entry = stat.name;
    if (!names_.emplace(entry).second)
      return fail(ErrorCode::duplicate, "the archive has two files of this name", shown_name(entry), "pack it again");
    if (auto storage = check_storage(zip, index, stat); !storage) return storage;
    return place({index, std::string(entry), "", stat.size});
  }

  /// The X3D file; a fault where there is none.
  [[nodiscard]] Expected<Item> text() const {
    if (text_) return *text_;
    return fail(ErrorCode::missing, "there is no X3D file in the archive", exhibit_,
                "pack the exhibit's folder: NAME/NAME.x3d, and its files as NAME/files/FILE");
  }
  [[nodiscard]] const std::string& exhibit() const { return exhibit_; }
  [[nodiscard]] const std::vector<Item>& files() const { return files_; }

 private:
  static Expected<void> check_storage(zip_t* zip, zip_uint64_t index, const zip_stat_t& stat) {
    const std::string name = shown_name(stat.name);
    if ((stat.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 && stat.encryption_method != ZIP_EM_NONE)
      return fail(ErrorCode::not_supported, "this file is encrypted", name, "pack it again without a password");
    if (stat.comp_method != ZIP_CM_STORE && stat.comp_method != ZIP_CM_DEFLATE)
      return fail(ErrorCode::not_supported, "this file is compressed in a way that is not read here", name,
                  "pack it again with the usual compression of zip archives, deflate");
    zip_uint8_t system = 0;
    zip_uint32_t attributes = 0;
    const bool known = zip_file_get_external_attributes(zip, index, 0, &system, &attributes) == 0;
    const mode_t mode = known && system != ZIP_OPSYS_DOS ? attributes >> 16U : 0;
    if ((mode & S_IFMT) == 0 || S_ISREG(mode) || S_ISDIR(mode)) return {};
    return fail(ErrorCode::not_supported, "this is a link or a device, not a file", name,
                "pack the file that it leads to");
  }

  /// By its name: NAME/, NAME/files/, NAME/NAME.x3d or NAME/files/FILE. No other name is taken, so none leads elsewhere.
  Expected<void> place(Item item) {
    const std::size_t slash = std::min(item.entry.find('/'), item.entry.size());
    const std::string folder = item.entry.substr(0, slash);
    if (!is_exhibit_name(folder) || slash == item.entry.size()) return strange_entry(item.entry);
    if (exhibit_.empty()) exhibit_ = folder;
    if (folder != exhibit_)
      return fail(ErrorCode::invalid_value, "the archive has more than one folder", shown_name(item.entry),
                  "pack one exhibit's folder alone");
    const std::string rest = item.entry.substr(slash + 1);
    constexpr std::string_view kBelow = "files/";
    if (rest.empty() || rest == kBelow) return {};
    if (rest == exhibit_ + ".x3d") return take_text(std::move(item));
    if (rest.ends_with(".x3d") && rest.find('/') == std::string::npos)
      return fail(ErrorCode::invalid_value, "this X3D file is not the exhibit's, whose name is that of its folder",
                  shown_name(item.entry), fmt::format("pack {0}/{0}.x3d alone, and meshes in {0}/files", exhibit_));
    if (!rest.starts_with(kBelow) || !is_file_name(std::string_view(rest).substr(kBelow.size())))
      return strange_entry(item.entry);
    item.name = rest.substr(kBelow.size());
    return take_file(std::move(item));
  }
  Expected<void> take_text(Item item) {
    if (item.bytes > Draft::kMostBytes)
      return fail(ErrorCode::too_large, "the X3D file has more than 16 MiB", item.entry, "keep shapes in mesh files");
    text_ = std::move(item);
    return {};
  }
  Expected<void> take_file(Item item) {
    if (item.bytes > DraftFiles::kMostBytes)
      return fail(ErrorCode::too_large, "the file has more than 64 MiB", item.entry, "make it smaller");
    together_ += item.bytes;
    files_.push_back(std::move(item));
    if (files_.size() > DraftFiles::kMostFiles || together_ > DraftFiles::kMostOfAll) return too_much();
    return {};
  }

  std::set<std::string, std::less<>> names_;
  std::string exhibit_;
  std::optional<Item> text_;
  std::vector<Item> files_;
  std::uintmax_t together_ = 0;
};

/// How many entries there can be at most: libzip would read millions of them into memory before anything can be asked.
std::size_t headers_in(std::string_view bytes) {
  constexpr std::string_view kHeader = "PK\1\2";
  std::size_t count = 0;
  for (std::size_t at = bytes.find(kHeader); at != std::string_view::npos && count <= 2 * kMostEntries;
       at = bytes.find(kHeader, at + 1))
    ++count;
  return count;
}

/// No more bytes than the list of entries says, whatever they unpack to.
Expected<std::string> read_item(zip_t* zip, const Item& item) {
  const ZipFile file(zip_fopen_index(zip, item.index, 0));
  const auto damaged = [&] {
    return fail(ErrorCode::invalid_value, "this file is damaged, or has another size than the archive says", item.entry,
                "export the exhibit again, and copy all of the file");
  };
  if (!file) return damaged();
  std::string bytes;
  std::array<char, 65536> some{};
  for (;;) {
    const zip_int64_t got = zip_fread(file.get(), some.data(), some.size());
    if (got < 0 || bytes.size() + static_cast<std::size_t>(got) > item.bytes) return damaged();
    if (got == 0) break;
    bytes.append(some.data(), static_cast<std::size_t>(got));
  }
  if (bytes.size() != item.bytes) return damaged();
  return bytes;
}

/// `source` keeps its bytes until the archive is written.
Expected<void> add_entry(zip_t* zip, const std::string& name, ZipSource source) {
  const zip_int64_t index = source ? zip_file_add(zip, name.c_str(), source.get(), ZIP_FL_ENC_UTF_8) : -1;
  if (index < 0) return fail(ErrorCode::io_failure, zip_strerror(zip), name, "try again");
  (void)source.release();  // the archive's now
  const auto at = static_cast<zip_uint64_t>(index);
  constexpr zip_uint32_t kPlainFile = zip_uint32_t{S_IFREG | 0644U} << 16U;
  if (zip_set_file_compression(zip, at, ZIP_CM_STORE, 0) != 0 ||
      zip_file_set_dostime(zip, at, 0, kFirstDosDay, 0) != 0 ||
      zip_file_set_external_attributes(zip, at, 0, ZIP_OPSYS_UNIX, kPlainFile) != 0)
    return fail(ErrorCode::io_failure, zip_strerror(zip), name, "try again");
  return {};
}

Expected<void> check_sizes(std::string_view text, std::span<const ArchiveSource> files) {
  std::uintmax_t together = text.size();
  for (const ArchiveSource& file : files) {
    std::error_code error;
    together += fs::file_size(file.path, error);
    if (error) return tl::unexpected(file_error("cannot be read", file.path, error.value()));
  }
  constexpr std::size_t kForHeaders = std::size_t{1} << 20U;
  if (files.size() <= DraftFiles::kMostFiles && together + kForHeaders <= kMostArchiveBytes) return {};
  return fail(ErrorCode::too_large, "the exhibit and what it uses have more than 127 MiB, or more than 200 files", "",
              "make the largest meshes and sounds smaller");
}

Expected<std::string> bytes_of_source(zip_source_t* source) {
  zip_stat_t stat{};
  if (zip_source_stat(source, &stat) != 0 || zip_source_open(source) != 0)
    return fail(ErrorCode::io_failure, "the archive cannot be made: there is too little memory", "", "try again");
  std::string bytes(stat.size, '\0');
  const zip_int64_t got = zip_source_read(source, bytes.data(), bytes.size());
  zip_source_close(source);
  if (got != static_cast<zip_int64_t>(bytes.size()))
    return fail(ErrorCode::io_failure, "the archive cannot be read back", "", "try again");
  return bytes;
}

}  // namespace

Expected<std::string> write_archive(const std::string& name, std::string_view text,
                                    std::span<const ArchiveSource> files) {
  if (auto fits = check_sizes(text, files); !fits) return tl::unexpected(fits.error());
  const ZipSource out(zip_source_buffer_create(nullptr, 0, 0, nullptr));
  const auto no_memory = [] { return fail(ErrorCode::io_failure, "there is too little memory", "", "try again"); };
  if (!out) return no_memory();
  zip_source_keep(out.get());  // its bytes are read after the archive has ended
  Zip zip(zip_open_from_source(out.get(), ZIP_TRUNCATE, nullptr));
  if (!zip) {
    zip_source_free(out.get());
    return no_memory();
  }
  auto added = add_entry(zip.get(), fmt::format("{0}/{0}.x3d", name),
                         ZipSource(zip_source_buffer(zip.get(), text.data(), text.size(), 0)));
  std::vector<ArchiveSource> sorted(files.begin(), files.end());
  std::ranges::sort(sorted, {}, &ArchiveSource::name);
  for (std::size_t i = 0; added && i < sorted.size(); ++i)
    added = add_entry(zip.get(), fmt::format("{}/{}/{}", name, kFilesFolder, sorted[i].name),
                      ZipSource(zip_source_file(zip.get(), sorted[i].path.c_str(), 0, -1)));
  if (!added) return tl::unexpected(added.error());
  if (zip_close(zip.get()) != 0)
    return fail(ErrorCode::io_failure, fmt::format("the archive cannot be made: {}", zip_strerror(zip.get())), name,
                "look whether its files can be read, and try again");
  (void)zip.release();
  return bytes_of_source(out.get());
}

Expected<ArchivedExhibit> read_archive(std::span<const std::byte> bytes, const TakeFile& take) {
  if (bytes.size() > kMostArchiveBytes)
    return fail(ErrorCode::too_large, "the archive has more than 128 MiB", "", "make meshes and sounds smaller");
  if (bytes.empty()) return no_archive();
  if (headers_in(as_text(bytes)) > 2 * kMostEntries) return too_much();
  ZipSource source(zip_source_buffer_create(bytes.data(), bytes.size(), 0, nullptr));
  const Zip zip(source ? zip_open_from_source(source.get(), ZIP_RDONLY, nullptr) : nullptr);
  if (!zip) return no_archive();
  (void)source.release();  // the archive's now
  Contents contents;
  const auto count = static_cast<zip_uint64_t>(std::max<zip_int64_t>(zip_get_num_entries(zip.get(), 0), 0));
  if (count > kMostEntries) return too_much();
  for (zip_uint64_t index = 0; index < count; ++index)
    if (auto added = contents.add(zip.get(), index); !added) return tl::unexpected(added.error());
  const auto item = contents.text();
  if (!item) return tl::unexpected(item.error());
  auto text = read_item(zip.get(), *item);
  if (!text) return tl::unexpected(text.error());
  for (const Item& file : contents.files()) {
    const auto read = read_item(zip.get(), file);
    if (!read) return tl::unexpected(read.error());
    if (auto taken = take(file.name, std::as_bytes(std::span(*read))); !taken) return tl::unexpected(taken.error());
  }
  return ArchivedExhibit{contents.exhibit(), std::move(*text)};
}

}  // namespace mechane::studio
