// All drafts of a museum: opened, changed, kept as versions, published, discarded. Answers are the JSON of COMMANDS.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "client-sdk/studio/draft/draft.hpp"
#include "client-sdk/studio/draft/draft_files.hpp"
#include "client-sdk/studio/draft/versions.hpp"
#include "client-sdk/studio/edits/apply.hpp"
#include "client-sdk/studio/shelf/catalogue.hpp"
#include "client-sdk/studio/shelf/exhibit_facts.hpp"
#include "client-sdk/studio/shelf/records.hpp"
#include "client-sdk/studio/shelf/shelf_fault.hpp"
#include "server/state/description.hpp"
#include "server/x3d/document.hpp"
#include "server/x3d/problem.hpp"

namespace mechane::studio {

/// A draft compiled: what a server would make of it.
struct CompiledDraft {
  state::WorldDescription world;
  std::filesystem::path exhibit_folder;  ///< what urls are relative to
  std::filesystem::path file;            ///< with the draft's text: where the world's own shapes are
  std::string own_url;                   ///< the url that stands for this file
};

/// A draft laid out for a server to try.
struct PreviewDraft {
  std::shared_ptr<const state::WorldDescription> world;
  std::filesystem::path file;
  std::int64_t revision = 0;
  std::string step{};  ///< where it begins: "use/lift"; empty: where the exhibit does
};

/// Owns the folder `state`; one program at a time. One thread, which may wait for the disk.
class Shelf {
 public:
  static constexpr std::size_t kMostDrafts = 500;
  static constexpr std::size_t kMostOpen = 16;  ///< kept in memory
  static constexpr std::size_t kMostPictureBytes = std::size_t{64} << 10U;

  /// `scenarios`: the server's folder of exhibits.
  Shelf(std::filesystem::path scenarios, std::filesystem::path state);

  [[nodiscard]] ShelfResult<std::string> list();
  /// `from`: "exhibit:NAME" or "template:NAME". A draft that began as that is opened; an exhibit's own draft in any case.
  [[nodiscard]] ShelfResult<std::string> begin(const std::string& name, const std::string& from, const Author& author);
  [[nodiscard]] ShelfResult<std::string> view(const std::string& name);
  [[nodiscard]] ShelfResult<std::string> text(const std::string& name);
  [[nodiscard]] ShelfResult<std::string> change(const std::string& name, const CommandList& list, const Author& author);
  [[nodiscard]] ShelfResult<std::string> undo(const std::string& name, std::int64_t revision, const Author& author);
  [[nodiscard]] ShelfResult<std::string> redo(const std::string& name, std::int64_t revision, const Author& author);
  [[nodiscard]] ShelfResult<std::string> versions(const std::string& name);
  [[nodiscard]] ShelfResult<std::string> add_version(const std::string& name, const std::string& title,
                                                     const Author& author);
  [[nodiscard]] ShelfResult<std::string> restore(const std::string& name, std::int64_t version, std::int64_t revision,
                                                 const Author& author);
  [[nodiscard]] ShelfResult<std::string> publish(const std::string& name, std::int64_t revision, const Author& author);
  [[nodiscard]] ShelfResult<std::string> discard(const std::string& name, std::int64_t revision);
  /// Meshes and sounds of a draft, and where it names them.
  [[nodiscard]] ShelfResult<std::string> files(const std::string& name);
  /// As DraftFiles::put(). Undo does not take it back. Returns the list of files.
  [[nodiscard]] ShelfResult<std::string> add_file(const std::string& name, const std::string& file,
                                                  std::span<const std::byte> bytes, bool replace);
  /// Deletes a file that no draft and no published exhibit names. Undo does not bring it back. Returns the list of files.
  [[nodiscard]] ShelfResult<std::string> remove_file(const std::string& name, const std::string& file);
  /// The draft as one file, or the exhibit where there is no draft: an archive with all meshes and sounds that it names.
  [[nodiscard]] ShelfResult<std::string> pack(const std::string& name);
  /// A new draft from an archive of unknown origin. Where anything is refused, nothing is left of it. Returns the view.
  [[nodiscard]] ShelfResult<std::string> unpack(const std::string& name, std::span<const std::byte> archive,
                                                const Author& author);
  /// Adds all of another exhibit to the draft, as one step: "exhibit:NAME" as it is published, or "draft:NAME". Its own files come into the
  /// draft's. Returns the view, with what had to be renamed.
  [[nodiscard]] ShelfResult<std::string> merge(const std::string& name, std::int64_t revision, const std::string& from,
                                               const Author& author);
  /// All that the museum has and fits the query.
  [[nodiscard]] ShelfResult<std::string> catalogue(const CatalogueQuery& query);
  /// Writes what is said of a mesh or a sound. Errors: conflict, where somebody else has written of it meanwhile.
  [[nodiscard]] ShelfResult<std::string> describe(const AboutRequest& request);
  /// A copy of a mesh or sound of the museum, with its record, comes among the draft's files; by another name where its own is taken.
  /// Returns the list of files, with the name as `taken`.
  [[nodiscard]] ShelfResult<std::string> take_file(const std::string& name, const std::string& path);
  /// How the draft looks, as a WebP picture: the draft's own, or the exhibit's where the draft has none. Errors: not_found.
  [[nodiscard]] ShelfResult<std::string> picture(const std::string& name) const;
  /// Bytes from anywhere. Undo does not take it back; publishing the draft publishes it. Errors: invalid_value; too_large; io_failure.
  [[nodiscard]] ShelfResult<std::string> set_picture(const std::string& name, std::span<const std::byte> webp);
  /// What bodies can be made of a mesh file: its nodes with the volumes of those that are closed. It imports the file.
  [[nodiscard]] ShelfResult<std::string> nodes_of_file(const std::string& name, const std::string& file);
  [[nodiscard]] ShelfResult<CompiledDraft> compile(const std::string& name);
  /// Writes the draft, which has no errors, where its urls mean what they mean in the exhibit; see preview_file.hpp.
  /// `step`: where it begins, see begin_at.hpp; empty: where the exhibit does.
  [[nodiscard]] ShelfResult<PreviewDraft> lay_out(const std::string& name, std::int64_t revision,
                                                  const std::string& step = "");

 private:
  struct Open {
    Draft draft;
    std::int64_t checked = -1;  ///< the revision that `problems` are of
    std::vector<x3d::Problem> problems{};
    std::uint64_t used = 0;
  };
  /// An exhibit's or a draft's file, as it was read.
  struct KnownFile {
    std::filesystem::file_time_type changed;
    std::filesystem::file_time_type read;
    std::uintmax_t size = 0;
    ExhibitFacts facts;
  };
  /// The draft as it is read, or what is published.
  [[nodiscard]] ShelfResult<x3d::Document> document_of(const std::string& name, bool drafted);
  /// The file of a path in such a document; empty: it is not there, not among the museum's exhibits, or the document itself.
  [[nodiscard]] std::filesystem::path file_at(const std::string& name, bool drafted, const std::string& path) const;
  /// A name that no draft and no exhibit has, and a place for another draft.
  [[nodiscard]] ShelfResult<void> need_place(const std::string& name, bool of_exhibit);
  [[nodiscard]] Expected<void> unpack_to(const std::filesystem::path& folder, const std::string& name,
                                         std::span<const std::byte> archive, const Author& author) const;
  [[nodiscard]] ShelfResult<Open*> open(const std::string& name);
  [[nodiscard]] ShelfResult<Open*> open_at(const std::string& name, std::int64_t revision);
  Open& keep(const std::string& name, Draft draft);
  [[nodiscard]] ShelfResult<std::string> view_of(const std::string& name, Open& open,
                                                 std::vector<std::string> added = {});
  /// With a look into mesh files. Errors: the draft's.
  [[nodiscard]] ShelfResult<void> check_whole(const std::string& name, const Draft& draft) const;
  const std::vector<x3d::Problem>& problems_of(const std::string& name, Open& open);
  /// Of an exhibit as it is published or drafted; nothing of a file that is not there or cannot be read.
  [[nodiscard]] const ExhibitFacts& facts_of(const std::string& name, bool drafted);
  /// By path in the museum, who names it: drafts, and what is published where its draft does not name it in the same place.
  using FileUses = std::map<std::string, std::vector<FileUse>>;
  [[nodiscard]] FileUses all_uses();
  void add_exhibit_items(std::vector<CatalogueItem>& items);
  void add_file_items(const FileUses& uses, std::vector<CatalogueItem>& items) const;
  /// What is written of a file; of the museum's own the note of its licence, and of a sound the languages of the steps that play it.
  [[nodiscard]] Record about_file(const std::string& path, const RecordMap& records, const FileUses& uses) const;
  /// What is said of files goes with their copies, which have these names among an exhibit's.
  void copy_records(const std::string& to, const std::map<std::string, std::string>& names);
  /// The mesh or sound at this path in the museum; empty where it does not exist.
  [[nodiscard]] std::filesystem::path museum_file(const std::string& path) const;
  /// Where picture() is found. Errors: not_found.
  [[nodiscard]] Expected<std::vector<std::byte>> picture_bytes(const std::string& name) const;
  [[nodiscard]] Expected<std::string> first_text(const std::string& name, const std::string& from);
  [[nodiscard]] DraftFiles files_of(const std::string& name) const;
  /// Those in the folder `files` of `from` that the text names; see copy_used().
  [[nodiscard]] Expected<std::vector<std::string>> copy_files(const std::string& name, const std::string& text,
                                                              const std::filesystem::path& from,
                                                              const std::filesystem::path& to) const;
  [[nodiscard]] std::filesystem::path exhibit_file(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> exhibit_names() const;
  [[nodiscard]] std::vector<std::string> draft_names() const;
  [[nodiscard]] std::vector<std::string> all_names() const;

  std::filesystem::path scenarios_;
  std::filesystem::path state_;
  Records records_;
  std::map<std::string, Open> open_;
  std::map<std::filesystem::path, KnownFile> known_;
  std::uint64_t uses_ = 0;
};

}  // namespace mechane::studio
