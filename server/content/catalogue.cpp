#include "server/content/catalogue.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include "server/base/utf8.hpp"
#include "server/content/content_command.hpp"
#include "server/database/sqlite_file.hpp"

namespace mechane::content {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFewestHashDigits = 6;

/// What an entry has several of (titles, languages, tags, references, wordings) has a table of its own.
constexpr std::array<const char*, 7> kCatalogueTables{
    "CREATE TABLE entry (id INTEGER PRIMARY KEY, path TEXT NOT NULL UNIQUE, kind TEXT NOT NULL, name TEXT NOT NULL, "
    "hash TEXT NOT NULL, bytes INTEGER NOT NULL, licence TEXT NOT NULL, source TEXT NOT NULL, author TEXT NOT NULL, "
    "version TEXT NOT NULL) STRICT",
    "CREATE TABLE title (entry INTEGER NOT NULL REFERENCES entry ON DELETE CASCADE, language TEXT NOT NULL, "
    "words TEXT NOT NULL, PRIMARY KEY (entry, language)) STRICT, WITHOUT ROWID",
    "CREATE TABLE language (entry INTEGER NOT NULL REFERENCES entry ON DELETE CASCADE, value TEXT NOT NULL, "
    "PRIMARY KEY (entry, value)) STRICT, WITHOUT ROWID",
    "CREATE TABLE tag (entry INTEGER NOT NULL REFERENCES entry ON DELETE CASCADE, value TEXT NOT NULL, "
    "PRIMARY KEY (entry, value)) STRICT, WITHOUT ROWID",
    "CREATE TABLE refers_to (entry INTEGER NOT NULL REFERENCES entry ON DELETE CASCADE, value TEXT NOT NULL, "
    "PRIMARY KEY (entry, value)) STRICT, WITHOUT ROWID",
    "CREATE TABLE wording (entry INTEGER NOT NULL REFERENCES entry ON DELETE CASCADE, words TEXT NOT NULL, "
    "language TEXT NOT NULL, PRIMARY KEY (entry, words, language)) STRICT, WITHOUT ROWID",
    "CREATE INDEX entry_hash ON entry (hash)",
};
constexpr database::Schema kCatalogueSchema{.application_id = 0x4d454348,  // "MECH"
                                            .version = 1,
                                            .statements = kCatalogueTables};

database::FileWords words_for(const fs::path& file) {
  return {.name = "the catalogue",
          .not_of_this_kind = "this is not a catalogue",
          .name_another = "name another file with --catalogue",
          .begin_anew = fmt::format("{}; then repeat what was once said with --licence, --author and the like",
                                    remake_command(file)),
          .after_a_failure = "the catalogue is as it was"};
}

tl::unexpected<Error> explain(const SQLite::Exception& e, const fs::path& file, const std::string& doing) {
  return tl::unexpected(database::explain(e, file, doing, words_for(file)));
}

struct KindWords {
  std::string_view word;
  std::string_view endings;  ///< with a blank around each
};
constexpr std::array<KindWords, kContentKinds> kKinds{{{"scenario", " .x3d "},
                                                       {"model", " .glb .gltf .obj .stl .ply "},
                                                       {"part", " .part "},
                                                       {"texture", " .png .jpg .jpeg .ktx2 .webp .tga .bmp "},
                                                       {"sound", " .ogg .opus .wav .flac .mp3 "},
                                                       {"text", " .md .html .vtt "}}};

void sort_once(std::vector<std::string>& values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// As the tables give it back: each value once, in order.
CatalogueEntry in_order(CatalogueEntry entry) {
  sort_once(entry.languages);
  sort_once(entry.tags);
  sort_once(entry.refers_to);
  for (auto& [words, languages] : entry.wordings) {
    sort_once(languages);
    std::erase(languages, "");
  }
  return entry;
}

bool is_hash(std::string_view text) {
  return text.size() == 32 && std::ranges::all_of(text, [](unsigned char c) { return std::isxdigit(c) != 0; });
}

}  // namespace

std::string_view word_of(ContentKind kind) {
  return kKinds[static_cast<std::size_t>(kind)].word;
}

std::optional<ContentKind> kind_of_word(std::string_view word) {
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (kKinds[i].word == word) return static_cast<ContentKind>(i);
  }
  return {};
}

std::optional<ContentKind> kind_of_file(const fs::path& file) {
  const std::string ending = lower_case(file.extension().string());
  if (ending.empty()) return {};
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (kKinds[i].endings.find(" " + ending + " ") != std::string_view::npos) return static_cast<ContentKind>(i);
  }
  return {};
}

fs::path folder_of_catalogue(const fs::path& file) {
  std::error_code code;
  return fs::weakly_canonical(fs::absolute(file, code).parent_path(), code);
}

bool is_inside(std::string_view text) {
  const fs::path path(text);
  if (text.empty() || text.find('\0') != std::string_view::npos || path.is_absolute() || text.back() == '/')
    return false;
  return path.lexically_normal().native() == text && *path.begin() != ".." && *path.begin() != ".";
}

Expected<std::string> path_inside(const fs::path& folder, const fs::path& path) {
  std::error_code code;
  const fs::path from = fs::weakly_canonical(folder, code);
  if (code) return fail(ErrorCode::io_failure, code.message(), folder.string(), "check the folder");
  // The name itself may be a link; the folder that it stands in may not lead elsewhere.
  const fs::path whole = fs::absolute(path, code).lexically_normal();
  const fs::path parent = fs::weakly_canonical(whole.parent_path(), code);
  if (code) return fail(ErrorCode::io_failure, code.message(), path.string(), "check the path");
  std::string inside = (parent / whole.filename()).lexically_relative(from).generic_string();
  if (!is_inside(inside)) {
    return fail(ErrorCode::conflict, "the file is not in the catalogue's folder", path.string(),
                fmt::format("move it into {}, or name a catalogue beside it with --catalogue", from.string()));
  }
  return inside;
}

/// The database. The functions of Catalogue catch SQLite's exceptions.
struct Catalogue::Connection {
  explicit Connection(const fs::path& file, Access access)
      : db(file.string(),
           access == Access::write ? SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE : SQLite::OPEN_READONLY,
           database::kBusyTimeout_ms) {
    database::distrust(db);
  }

  /// Call it in a transaction, so that all tables are of the same moment.
  [[nodiscard]] std::vector<CatalogueEntry> read_now() const;
  void write(const CatalogueEntry& entry);
  void write_values(std::int64_t id, const char* table, const std::vector<std::string>& values);

  mutable SQLite::Database db;
};

void Catalogue::Connection::write_values(std::int64_t id, const char* table, const std::vector<std::string>& values) {
  SQLite::Statement insert(db, fmt::format("INSERT OR IGNORE INTO {} VALUES (?, ?)", table));
  for (const std::string& value : values) {
    insert.bind(1, id);
    insert.bind(2, value);
    insert.exec();
    insert.reset();
  }
}

void Catalogue::Connection::write(const CatalogueEntry& entry) {
  SQLite::Statement forget(db, "DELETE FROM entry WHERE path = ?");
  forget.bind(1, entry.path);
  forget.exec();
  SQLite::Statement insert(db,
                           "INSERT INTO entry (path, kind, name, hash, bytes, licence, source, author, version) "
                           "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
  int column = 0;
  for (const std::string& text : {entry.path, std::string(word_of(entry.kind)), entry.name, entry.hash})
    insert.bind(++column, text);
  insert.bind(++column, static_cast<std::int64_t>(entry.bytes));
  const Credits& c = entry.credits;
  for (const std::string& text : {c.licence, c.source, c.author, c.version})
    insert.bind(++column, text);
  insert.exec();
  const std::int64_t id = db.getLastInsertRowid();
  write_values(id, "language", entry.languages);
  write_values(id, "tag", entry.tags);
  write_values(id, "refers_to", entry.refers_to);
  SQLite::Statement title(db, "INSERT INTO title VALUES (?, ?, ?)");
  for (const auto& [language, words] : entry.titles) {
    title.bind(1, id);
    title.bind(2, language);
    title.bind(3, words);
    title.exec();
    title.reset();
  }
  SQLite::Statement wording(db, "INSERT OR IGNORE INTO wording VALUES (?, ?, ?)");
  for (const auto& [words, languages] : entry.wordings) {
    for (const std::string& language : languages.empty() ? std::vector<std::string>{""} : languages) {
      wording.bind(1, id);
      wording.bind(2, words);
      wording.bind(3, language);  // "": said in no language at all
      wording.exec();
      wording.reset();
    }
  }
}

std::vector<CatalogueEntry> Catalogue::Connection::read_now() const {
  std::map<std::int64_t, CatalogueEntry> by_id;
  SQLite::Statement rows(
      db, "SELECT id, path, kind, name, hash, bytes, licence, source, author, version FROM entry ORDER BY path");
  while (rows.executeStep()) {
    CatalogueEntry entry;
    entry.path = rows.getColumn(1).getString();
    const auto kind = kind_of_word(rows.getColumn(2).getString());
    entry.name = rows.getColumn(3).getString();
    entry.hash = rows.getColumn(4).getString();
    const std::int64_t bytes = rows.getColumn(5).getInt64();
    // A path that leaves the folder would lead an export, or a display, to other files of the machine.
    if (!kind || !is_inside(entry.path) || !is_hash(entry.hash) || bytes < 0)
      database::throw_damaged("not a valid entry: " + entry.path);
    entry.kind = *kind;
    entry.bytes = static_cast<std::uint64_t>(bytes);
    entry.credits = {rows.getColumn(6).getString(), rows.getColumn(7).getString(), rows.getColumn(8).getString(),
                     rows.getColumn(9).getString()};
    by_id.emplace(rows.getColumn(0).getInt64(), std::move(entry));
  }
  const auto each = [&](const char* query, const auto& use) {
    SQLite::Statement values(db, query);
    while (values.executeStep()) {
      const auto entry = by_id.find(values.getColumn(0).getInt64());
      if (entry != by_id.end()) use(entry->second, values);
    }
  };
  each("SELECT entry, language, words FROM title",
       [](CatalogueEntry& e, SQLite::Statement& s) { e.titles[s.getColumn(1)] = s.getColumn(2).getString(); });
  each("SELECT entry, value FROM language ORDER BY value",
       [](CatalogueEntry& e, SQLite::Statement& s) { e.languages.push_back(s.getColumn(1)); });
  each("SELECT entry, value FROM tag ORDER BY value",
       [](CatalogueEntry& e, SQLite::Statement& s) { e.tags.push_back(s.getColumn(1)); });
  each("SELECT entry, value FROM refers_to ORDER BY value",
       [](CatalogueEntry& e, SQLite::Statement& s) { e.refers_to.push_back(s.getColumn(1)); });
  each("SELECT entry, words, language FROM wording ORDER BY language", [](CatalogueEntry& e, SQLite::Statement& s) {
    std::vector<std::string>& languages = e.wordings[s.getColumn(1)];
    if (!s.getColumn(2).getString().empty()) languages.push_back(s.getColumn(2));
  });
  std::vector<CatalogueEntry> all;
  all.reserve(by_id.size());
  for (auto& [id, entry] : by_id)
    all.push_back(std::move(entry));
  std::ranges::sort(all, {}, &CatalogueEntry::path);
  return all;
}

Catalogue::Catalogue(fs::path file, std::unique_ptr<Connection> connection)
    : file_(std::move(file)), connection_(std::move(connection)) {
  folder_ = folder_of_catalogue(file_);
}
Catalogue::Catalogue(Catalogue&&) noexcept = default;
Catalogue& Catalogue::operator=(Catalogue&&) noexcept = default;
Catalogue::~Catalogue() = default;

Expected<Catalogue> Catalogue::open(const fs::path& file, Access access) {
  std::error_code code;
  const bool there = fs::exists(file, code);
  if (!there && access == Access::read) {
    return fail(ErrorCode::not_found, "there is no catalogue", file.string(),
                fmt::format("make it: {}; or name another with --catalogue", content_command(file, "add", "FOLDER")));
  }
  if (there && access == Access::read && fs::is_regular_file(file, code) && fs::file_size(file, code) == 0) {
    return fail(ErrorCode::not_found, "the file is empty: no catalogue has been made in it yet", file.string(),
                content_command(file, "add", "FOLDER"));
  }
  if (there && !fs::is_regular_file(file, code)) {
    return fail(ErrorCode::invalid_value, "this is not a catalogue but a folder or a device", file.string(),
                "name a file with --catalogue");
  }
  try {
    auto connection = std::make_unique<Connection>(file, access);
    if (access == Access::write) database::make_tables(connection->db, kCatalogueSchema);
    if (auto ours = database::check(connection->db, file, kCatalogueSchema, words_for(file)); !ours)
      return tl::unexpected(ours.error());
    return Catalogue(file, std::move(connection));
  } catch (const SQLite::Exception& e) {
    return explain(e, file, "opening it");
  }
}

Expected<Catalogue::Changes> Catalogue::put(std::span<const CatalogueEntry> entries) {
  try {
    SQLite::Transaction transaction(connection_->db, SQLite::TransactionBehavior::IMMEDIATE);
    std::map<std::string, CatalogueEntry> known;
    for (CatalogueEntry& entry : connection_->read_now())
      known.emplace(entry.path, std::move(entry));
    Changes changes;
    for (const CatalogueEntry& given : entries) {
      const CatalogueEntry entry = in_order(given);
      if (!is_inside(entry.path) || !is_hash(entry.hash))
        return fail(ErrorCode::invalid_value, "this cannot be an entry", entry.path,
                    "name a file inside the catalogue's folder");
      const auto old = known.find(entry.path);
      if (old != known.end() && old->second == entry) {
        ++changes.same;
        continue;
      }
      const bool same_file = old != known.end() && old->second.hash == entry.hash;
      (old == known.end() ? changes.added : same_file ? changes.retold : changes.changed).push_back(entry.path);
      connection_->write(entry);
      known[entry.path] = entry;
    }
    transaction.commit();
    return changes;
  } catch (const SQLite::Exception& e) {
    return explain(e, file_, "writing it");
  }
}

Expected<std::size_t> Catalogue::remove(std::span<const std::string> paths) {
  try {
    SQLite::Transaction transaction(connection_->db, SQLite::TransactionBehavior::IMMEDIATE);
    std::size_t removed = 0;
    SQLite::Statement forget(connection_->db, "DELETE FROM entry WHERE path = ?");
    for (const std::string& path : paths) {
      forget.bind(1, path);
      removed += static_cast<std::size_t>(forget.exec());
      forget.reset();
    }
    transaction.commit();
    return removed;
  } catch (const SQLite::Exception& e) {
    return explain(e, file_, "writing it");
  }
}

Expected<std::vector<CatalogueEntry>> Catalogue::entries() const {
  try {
    SQLite::Transaction transaction(connection_->db);  // all tables of the same moment
    return connection_->read_now();
  } catch (const SQLite::Exception& e) {
    return explain(e, file_, "reading it");
  }
}

Expected<std::vector<fs::path>> Catalogue::files_of(const std::string& hash) const {
  try {
    SQLite::Statement rows(connection_->db, "SELECT path FROM entry WHERE hash = ? ORDER BY path");
    rows.bind(1, hash);
    std::vector<fs::path> files;
    while (rows.executeStep()) {
      const std::string path = rows.getColumn(0).getString();
      if (is_inside(path)) files.push_back(folder_ / path);
    }
    return files;
  } catch (const SQLite::Exception& e) {
    return explain(e, file_, "reading it");
  }
}

std::vector<CatalogueEntry> find_entries(std::span<const CatalogueEntry> entries, std::string_view word) {
  std::vector<CatalogueEntry> found;
  const auto take = [&](const auto& fits) {
    if (found.empty()) std::ranges::copy_if(entries, std::back_inserter(found), fits);
  };
  take([&](const CatalogueEntry& e) { return e.path == word; });
  take([&](const CatalogueEntry& e) { return e.name == word; });
  const std::string digits = lower_case(std::string(word));
  if (digits.size() >= kFewestHashDigits) take([&](const CatalogueEntry& e) { return e.hash.starts_with(digits); });
  return found;
}

}  // namespace mechane::content
