#include "server/visits/visit_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <map>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

namespace mechane::visits {
namespace {

namespace fs = std::filesystem;
using Trouble = VisitFile::Trouble;

constexpr int kVisitApplicationId = 0x4d454356;  // "MECV", as PRAGMA application_id: `file` and sqlite3 show it
constexpr int kVisitSchemaVersion = 1;
constexpr int kVisitBusyTimeout_ms = 5000;
constexpr std::size_t kFewestLetters = 4;
constexpr std::int64_t kLastMinute = 253402300799 / 60;  // of the year 9999

/// Without rowids: the order of the file is that of random numbers, not that of visits.
constexpr std::array<const char*, 5> kVisitTables{
    "CREATE TABLE visit (number TEXT NOT NULL PRIMARY KEY, kiosk TEXT NOT NULL, scenario TEXT NOT NULL, "
    "scenario_hash TEXT NOT NULL, activity TEXT NOT NULL, language TEXT NOT NULL, minute INTEGER NOT NULL, "
    "duration_s REAL NOT NULL, from_start INTEGER NOT NULL, hands INTEGER NOT NULL, ending TEXT NOT NULL, "
    "went_on_to TEXT NOT NULL, notes_lost INTEGER NOT NULL) STRICT, WITHOUT ROWID",
    "CREATE TABLE step (visit TEXT NOT NULL REFERENCES visit ON DELETE CASCADE, place INTEGER NOT NULL, "
    "name TEXT NOT NULL, duration_s REAL NOT NULL, ending TEXT NOT NULL, hint_shown INTEGER NOT NULL, "
    "whole INTEGER NOT NULL, PRIMARY KEY (visit, place)) STRICT, WITHOUT ROWID",
    "CREATE TABLE mistake (visit TEXT NOT NULL REFERENCES visit ON DELETE CASCADE, place INTEGER NOT NULL, "
    "kind TEXT NOT NULL, subject TEXT NOT NULL, count INTEGER NOT NULL, PRIMARY KEY (visit, place)) STRICT, "
    "WITHOUT ROWID",
    "CREATE TABLE answer (visit TEXT NOT NULL REFERENCES visit ON DELETE CASCADE, place INTEGER NOT NULL, "
    "question TEXT NOT NULL, asked TEXT NOT NULL, value TEXT NOT NULL, mark INTEGER NOT NULL, "
    "marks INTEGER NOT NULL, is_right INTEGER, PRIMARY KEY (visit, place)) STRICT, WITHOUT ROWID",
    "CREATE TABLE remark (visit TEXT NOT NULL REFERENCES visit ON DELETE CASCADE, place INTEGER NOT NULL, "
    "minute INTEGER NOT NULL, text TEXT NOT NULL, PRIMARY KEY (visit, place)) STRICT, WITHOUT ROWID",
};
constexpr const char* kMinuteIndex = "CREATE INDEX visit_minute ON visit (minute)";

Trouble trouble_of(const SQLite::Exception& e) {
  const int code = e.getErrorCode();
  return code == SQLITE_NOTADB || code == SQLITE_CORRUPT ? Trouble::damaged : Trouble::other;
}

/// SQLite's reason in a person's words.
Error explain_visits(const SQLite::Exception& e, const fs::path& file, const std::string& doing) {
  const std::string where = file.string();
  switch (e.getErrorCode()) {
    case SQLITE_NOTADB:
      return {"these are not visits' sheets: SQLite does not know the file", where, "name another file with --file"};
    case SQLITE_CORRUPT:
      return {fmt::format("the file of sheets is damaged ({})", e.what()), where,
              "move it away: the server begins a new one; sqlite3's .recover may save some of the old"};
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH:
      return {fmt::format("{}: the file of sheets, or its folder, may not be written", doing), where,
              "check its rights"};
    case SQLITE_CANTOPEN:
      return {fmt::format("{}: the file cannot be opened", doing), where,
              "check that its folder is there, and their rights"};
    case SQLITE_FULL:
      return {fmt::format("{}: the disk is full", doing), where, "make room on the disk"};
    case SQLITE_IOERR:
      return {fmt::format("{}: the disk failed ({})", doing, sqlite3_errstr(e.getExtendedErrorCode())), where,
              "check the disk and its space"};
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {fmt::format("{}: another program is writing it", doing), where, "try again when that is done"};
    default:
      return {fmt::format("{}: {}", doing, e.what()), where, "check the file"};
  }
}

[[noreturn]] void damaged(const std::string& what) {
  throw SQLite::Exception(what, SQLITE_CORRUPT);
}

/// As a person types a number, as the file has it: "K7M2 9QXD" is "k7m2-9qxd".
std::string typed_number(std::string_view text) {
  std::string out;
  std::size_t letters = 0;
  for (const char c : text) {
    if (c == '-' || c == ' ') continue;
    if (letters > 0 && letters % 4 == 0) out += '-';
    out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    ++letters;
  }
  return out;
}

bool is_number(std::string_view text) {
  return text.size() == 14 &&
         std::ranges::all_of(text, [](unsigned char c) { return c == '-' || std::isalnum(c) != 0; });
}

bool is_good_remark(std::string_view text) {
  return std::ranges::none_of(text, [](unsigned char c) { return (c < 0x20 && c != '\n' && c != '\t') || c == 0x7f; });
}

/// As SQLite reads a name with options behind it.
std::string uri_of(const fs::path& file) {
  std::string uri = "file:";
  for (const char c : fs::absolute(file).string()) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '/' || c == '-' || c == '_' || c == '.';
    uri += plain ? std::string(1, c) : fmt::format("%{:02x}", static_cast<unsigned char>(c));
  }
  return uri;
}

/// The rest of a query that a choice asks for.
class ChoiceQuery {
 public:
  explicit ChoiceQuery(const VisitChoice& choice) : choice_(choice), number_(typed_number(choice.number)) {
    if (choice.since) text_ += " AND minute >= :since";
    if (choice.before) text_ += " AND minute < :before";
    if (!choice.scenario.empty()) text_ += " AND scenario = :scenario";
    if (!choice.kiosk.empty()) text_ += " AND kiosk = :kiosk";
    if (!number_.empty()) text_ += " AND substr(number, 1, length(:number)) = :number";
  }
  [[nodiscard]] bool chooses() const { return !text_.empty(); }
  [[nodiscard]] std::string after(const std::string& head) const { return head + " WHERE 1" + text_; }
  void bind(SQLite::Statement& statement) const {
    if (choice_.since) statement.bind(":since", *choice_.since);
    if (choice_.before) statement.bind(":before", *choice_.before);
    if (!choice_.scenario.empty()) statement.bind(":scenario", choice_.scenario);
    if (!choice_.kiosk.empty()) statement.bind(":kiosk", choice_.kiosk);
    if (!number_.empty()) statement.bind(":number", number_);
  }

 private:
  const VisitChoice& choice_;
  std::string number_;
  std::string text_;
};

/// One row; whatever a file from elsewhere says, it is a value of ours or the file is damaged.
struct Row {
  SQLite::Statement& statement;
  [[nodiscard]] std::string text(int column) const { return statement.getColumn(column).getString(); }
  [[nodiscard]] std::int64_t whole(int column, std::int64_t low, std::int64_t high) const {
    const std::int64_t value = statement.getColumn(column).getInt64();
    if (value < low || value > high) damaged(fmt::format("{} is {}", statement.getColumnName(column), value));
    return value;
  }
  [[nodiscard]] double seconds(int column) const {
    const double value = statement.getColumn(column).getDouble();
    if (!(value >= 0 && value <= 1e9)) damaged(fmt::format("{} is {}", statement.getColumnName(column), value));
    return value;
  }
  template <class Enum>
  [[nodiscard]] Enum word(int column, std::optional<Enum> (*of)(std::string_view)) const {
    const auto value = of(text(column));
    if (!value) damaged(fmt::format("{} is '{}'", statement.getColumnName(column), text(column)));
    return *value;
  }
};

VisitSheet sheet_of(const Row& row) {
  VisitSheet sheet;
  sheet.number = row.text(0);
  if (!is_number(sheet.number)) damaged("not a visit's number: " + sheet.number);
  sheet.kiosk = row.text(1);
  sheet.scenario = row.text(2);
  sheet.scenario_hash = row.text(3);
  sheet.activity = row.text(4);
  sheet.language = row.text(5);
  sheet.minute = row.whole(6, 0, kLastMinute);
  sheet.duration_s = row.seconds(7);
  sheet.from_start = row.whole(8, 0, 1) != 0;
  sheet.hands = static_cast<std::uint32_t>(row.whole(9, 0, 1000));
  sheet.ending = row.word(10, visit_ending_of);
  sheet.went_on_to = row.text(11);
  sheet.notes_lost = static_cast<std::uint32_t>(row.whole(12, 0, 0xffffffff));
  return sheet;
}

SheetAnswer answer_of(const Row& row) {
  SheetAnswer answer;
  answer.question = row.text(1);
  answer.when = row.word(2, answer_time_of);
  answer.value = row.text(3);
  answer.marks = static_cast<int>(row.whole(5, 0, 1000));
  answer.mark = static_cast<int>(row.whole(4, answer.marks > 0 ? 1 : 0, answer.marks));
  if (!row.statement.isColumnNull(6)) answer.right = row.whole(6, 0, 1) != 0;
  return answer;
}

}  // namespace

/// The database. SQLite's exceptions end in the functions of VisitFile.
struct VisitFile::Connection {
  Connection(const std::string& name, int flags) : db(name, flags, kVisitBusyTimeout_ms) {
    // The file may come from anywhere: nothing in its schema is run, and a page that lies about its cells is seen.
    sqlite3_db_config(db.getHandle(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(db.getHandle(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_db_config(db.getHandle(), SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
    sqlite3_db_config(db.getHandle(), SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
    // What is forgotten is written over with zeros.
    db.exec("PRAGMA foreign_keys = ON; PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0; PRAGMA secure_delete = ON");
  }

  static std::unique_ptr<Connection> open(const fs::path& file, Access access);

  [[nodiscard]] std::int64_t pragma(const char* name) const {
    return db.execAndGet(fmt::format("PRAGMA {}", name)).getInt64();
  }
  [[nodiscard]] bool has_tables() const { return db.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() != 0; }

  /// In one transaction, so that of two programs that make the same file one finds it made.
  void make_schema() {
    if (pragma("user_version") != 0 || has_tables()) return;
    db.exec("PRAGMA auto_vacuum = INCREMENTAL");  // before there is any page
    SQLite::Transaction transaction(db, SQLite::TransactionBehavior::IMMEDIATE);
    if (pragma("user_version") != 0 || has_tables()) return;
    for (const char* table : kVisitTables)
      db.exec(table);
    db.exec(kMinuteIndex);
    db.exec(
        fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", kVisitApplicationId, kVisitSchemaVersion));
    transaction.commit();
  }
  void write_ahead() { db.exec("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL"); }

  /// Tables that are word for word ours: what else a file may declare is never met.
  [[nodiscard]] bool has_our_tables() const {
    std::vector<std::string> wanted(kVisitTables.begin(), kVisitTables.end());
    wanted.emplace_back(kMinuteIndex);
    std::vector<std::string> found;
    SQLite::Statement rows(db, "SELECT coalesce(sql, '') FROM sqlite_schema WHERE name NOT LIKE 'sqlite_autoindex_%'");
    while (rows.executeStep() && found.size() <= wanted.size())
      found.push_back(rows.getColumn(0).getString());
    std::ranges::sort(wanted);
    std::ranges::sort(found);
    return wanted == found;
  }

  void write_head(const VisitSheet& sheet, const char* sql);
  void write_rows(const VisitSheet& sheet);
  /// To be called in a transaction: all tables must be of one moment.
  [[nodiscard]] std::vector<VisitSheet> read_now(const VisitChoice& choice) const;
  void read_rows(const VisitChoice& choice, std::map<std::string, VisitSheet>& by_number) const;
  std::size_t remove(const std::string& query, const std::function<void(SQLite::Statement&)>& bind);
  void shrink();
  [[nodiscard]] std::uint64_t used_bytes() const {
    return static_cast<std::uint64_t>((pragma("page_count") - pragma("freelist_count")) * pragma("page_size"));
  }

  mutable SQLite::Database db;
};

/// A file at rest, in a folder or on a disk that we may not write, is read as it is: SQLite would make its journal first.
std::unique_ptr<VisitFile::Connection> VisitFile::Connection::open(const fs::path& file, Access access) {
  if (access != Access::read) {
    const int made = access == Access::write_new ? SQLite::OPEN_CREATE : 0;
    return std::make_unique<Connection>(file.string(), SQLite::OPEN_READWRITE | made);
  }
  try {
    auto connection = std::make_unique<Connection>(file.string(), SQLite::OPEN_READONLY);
    (void)connection->has_tables();  // reads for the first time
    return connection;
  } catch (const SQLite::Exception& e) {
    std::error_code code;
    const bool at_rest = !fs::exists(file.string() + "-wal", code);
    if (!at_rest || (e.getErrorCode() != SQLITE_CANTOPEN && e.getErrorCode() != SQLITE_READONLY)) throw;
    return std::make_unique<Connection>(uri_of(file) + "?immutable=1", SQLite::OPEN_READONLY | SQLite::OPEN_URI);
  }
}

void VisitFile::Connection::write_head(const VisitSheet& sheet, const char* sql) {
  SQLite::Statement head(db, sql);
  int column = 0;
  for (const std::string& text :
       {sheet.number, sheet.kiosk, sheet.scenario, sheet.scenario_hash, sheet.activity, sheet.language})
    head.bind(++column, text);
  head.bind(++column, sheet.minute);
  head.bind(++column, sheet.duration_s);
  head.bind(++column, sheet.from_start ? 1 : 0);
  head.bind(++column, sheet.hands);
  head.bind(++column, std::string(word_of(sheet.ending)));
  head.bind(++column, sheet.went_on_to);
  head.bind(++column, sheet.notes_lost);
  head.exec();
}

void VisitFile::Connection::write_rows(const VisitSheet& sheet) {
  const auto insert = [&](const char* sql, std::size_t count, const auto& bind) {
    SQLite::Statement row(db, sql);
    for (std::size_t i = 0; i < count; ++i) {
      row.bind(1, sheet.number);
      row.bind(2, static_cast<std::int64_t>(i));
      bind(row, i);
      row.exec();
      row.reset();
    }
  };
  insert("INSERT INTO step VALUES (?, ?, ?, ?, ?, ?, ?)", sheet.steps.size(),
         [&](SQLite::Statement& row, std::size_t i) {
           const SheetStep& step = sheet.steps[i];
           row.bind(3, step.name);
           row.bind(4, step.duration_s);
           row.bind(5, std::string(word_of(step.ending)));
           row.bind(6, step.hint_shown ? 1 : 0);
           row.bind(7, step.whole ? 1 : 0);
         });
  insert("INSERT INTO mistake VALUES (?, ?, ?, ?, ?)", sheet.mistakes.size(),
         [&](SQLite::Statement& row, std::size_t i) {
           const SheetMistake& mistake = sheet.mistakes[i];
           row.bind(3, std::string(word_of(mistake.kind)));
           row.bind(4, mistake.subject);
           row.bind(5, mistake.count);
         });
  insert("INSERT INTO answer VALUES (?, ?, ?, ?, ?, ?, ?, ?)", sheet.answers.size(),
         [&](SQLite::Statement& row, std::size_t i) {
           const SheetAnswer& answer = sheet.answers[i];
           row.bind(3, answer.question);
           row.bind(4, std::string(word_of(answer.when)));
           row.bind(5, answer.value);
           row.bind(6, answer.mark);
           row.bind(7, answer.marks);
           row.bind(8);
           if (answer.right) row.bind(8, *answer.right ? 1 : 0);
         });
}

std::vector<VisitSheet> VisitFile::Connection::read_now(const VisitChoice& choice) const {
  const ChoiceQuery chosen(choice);
  std::map<std::string, VisitSheet> by_number;
  SQLite::Statement heads(db, chosen.after("SELECT * FROM visit"));
  chosen.bind(heads);
  while (heads.executeStep()) {
    VisitSheet sheet = sheet_of({heads});
    by_number.emplace(sheet.number, std::move(sheet));
  }
  read_rows(choice, by_number);
  std::vector<VisitSheet> sheets;
  sheets.reserve(by_number.size());
  for (auto& [number, sheet] : by_number)
    sheets.push_back(std::move(sheet));
  std::ranges::stable_sort(sheets, {}, &VisitSheet::minute);
  return sheets;
}

void VisitFile::Connection::read_rows(const VisitChoice& choice, std::map<std::string, VisitSheet>& by_number) const {
  const ChoiceQuery chosen(choice);
  const auto each = [&](const std::string& columns, const char* table, const auto& use) {
    SQLite::Statement rows(db, fmt::format("SELECT {} FROM {} WHERE visit IN ({}) ORDER BY visit, place", columns,
                                           table, chosen.after("SELECT number FROM visit")));
    chosen.bind(rows);
    while (rows.executeStep()) {
      const auto sheet = by_number.find(rows.getColumn(0).getString());
      if (sheet != by_number.end()) use(sheet->second, Row{rows});
    }
  };
  each("visit, name, duration_s, ending, hint_shown, whole", "step", [](VisitSheet& sheet, const Row& row) {
    sheet.steps.push_back(
        {row.text(1), row.seconds(2), row.word(3, step_ending_of), row.whole(4, 0, 1) != 0, row.whole(5, 0, 1) != 0});
  });
  each("visit, kind, subject, count", "mistake", [](VisitSheet& sheet, const Row& row) {
    sheet.mistakes.push_back(
        {row.word(1, mistake_kind_of), row.text(2), static_cast<std::uint32_t>(row.whole(3, 0, 1'000'000))});
  });
  each("visit, question, asked, value, mark, marks, is_right", "answer",
       [](VisitSheet& sheet, const Row& row) { sheet.answers.push_back(answer_of(row)); });
  each("visit, minute, text", "remark", [](VisitSheet& sheet, const Row& row) {
    sheet.remarks.push_back({row.whole(1, 0, kLastMinute), row.text(2)});
  });
}

std::size_t VisitFile::Connection::remove(const std::string& query,
                                          const std::function<void(SQLite::Statement&)>& bind) {
  SQLite::Transaction transaction(db, SQLite::TransactionBehavior::IMMEDIATE);
  SQLite::Statement forget(db, query);
  bind(forget);
  const auto removed = static_cast<std::size_t>(forget.exec());
  transaction.commit();
  return removed;
}

/// Gives pages back to the disk, and empties the journal, in which what was forgotten would stay readable.
void VisitFile::Connection::shrink() {
  SQLite::Statement vacuum(db, "PRAGMA incremental_vacuum");
  while (vacuum.executeStep()) {
  }
  SQLite::Statement checkpoint(db, "PRAGMA wal_checkpoint(TRUNCATE)");
  while (checkpoint.executeStep()) {
  }
}

VisitFile::VisitFile(fs::path file, std::unique_ptr<Connection> connection)
    : file_(std::move(file)), connection_(std::move(connection)) {}
VisitFile::VisitFile(VisitFile&&) noexcept = default;
VisitFile& VisitFile::operator=(VisitFile&&) noexcept = default;
VisitFile::~VisitFile() = default;

Expected<VisitFile> VisitFile::open(const fs::path& file, Access access, Trouble* trouble) {
  Trouble ignored = Trouble::none;
  Trouble& why = trouble != nullptr ? *trouble : ignored;
  std::error_code code;
  const bool there = fs::exists(file, code);
  why = Trouble::missing;
  if (!there && access != Access::write_new) {
    return fail("there are no visits' sheets", file.string(),
                "name the server's folder of records with --records, or a file with --file");
  }
  why = Trouble::foreign;
  if (there && !fs::is_regular_file(file, code))
    return fail("these are not visits' sheets but a folder or a device", file.string(), "name a file with --file");
  try {
    auto connection = Connection::open(file, access);
    if (access == Access::write_new) connection->make_schema();
    // Observers are of the server's group; nobody else's business. What SQLite keeps beside the file gets the same rights.
    if (!there) fs::permissions(file, fs::perms(0660), code);
    const std::int64_t version = connection->pragma("user_version");
    if (connection->pragma("application_id") != kVisitApplicationId) {
      return fail("this is a database of another program, and no visits' sheets", file.string(),
                  "name another file with --file");
    }
    if (version > kVisitSchemaVersion) {
      return fail(fmt::format("a newer Mechane has written these sheets (format {}; this one reads {})", version,
                              kVisitSchemaVersion),
                  file.string(), "update Mechane on this machine");
    }
    if (version != kVisitSchemaVersion || !connection->has_our_tables()) damaged("its tables are not those of sheets");
    const std::string check = connection->db.execAndGet("PRAGMA quick_check(1)").getString();
    if (check != "ok") damaged(check);
    if (access != Access::read) connection->write_ahead();
    why = Trouble::none;
    return VisitFile(file, std::move(connection));
  } catch (const SQLite::Exception& e) {
    why = trouble_of(e);
    return tl::unexpected(explain_visits(e, file, "opening it"));
  }
}

Expected<bool> VisitFile::put(const VisitSheet& sheet, bool is_new, Trouble* trouble) {
  try {
    SQLite::Transaction transaction(connection_->db, SQLite::TransactionBehavior::IMMEDIATE);
    if (is_new) {
      connection_->write_head(sheet, "INSERT INTO visit VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    } else {
      connection_->write_head(
          sheet,
          "UPDATE visit SET kiosk = ?2, scenario = ?3, scenario_hash = ?4, activity = ?5, language = ?6, minute = ?7, "
          "duration_s = ?8, from_start = ?9, hands = ?10, ending = ?11, went_on_to = ?12, notes_lost = ?13 "
          "WHERE number = ?1");
      if (connection_->db.getChanges() == 0) return false;
      for (const char* table : {"step", "mistake", "answer"}) {
        SQLite::Statement forget(connection_->db, fmt::format("DELETE FROM {} WHERE visit = ?", table));
        forget.bind(1, sheet.number);
        forget.exec();
      }
    }
    connection_->write_rows(sheet);
    transaction.commit();
    return true;
  } catch (const SQLite::Exception& e) {
    if (trouble != nullptr) *trouble = trouble_of(e);
    return tl::unexpected(explain_visits(e, file_, "writing a sheet"));
  }
}

Expected<std::vector<VisitSheet>> VisitFile::sheets(const VisitChoice& choice) const {
  try {
    SQLite::Transaction transaction(connection_->db);  // all tables as of one moment
    return connection_->read_now(choice);
  } catch (const SQLite::Exception& e) {
    return tl::unexpected(explain_visits(e, file_, "reading it"));
  }
}

Expected<std::size_t> VisitFile::count() const {
  try {
    return static_cast<std::size_t>(connection_->db.execAndGet("SELECT count(*) FROM visit").getInt64());
  } catch (const SQLite::Exception& e) {
    return tl::unexpected(explain_visits(e, file_, "reading it"));
  }
}

Expected<std::string> VisitFile::remark(const std::string& number, const SheetRemark& remark) {
  if (remark.text.empty() || remark.text.size() > kLongestRemark || !is_good_remark(remark.text)) {
    return fail(fmt::format("a remark of {} bytes cannot be kept", remark.text.size()), "visit " + number,
                fmt::format("write 1 to {} bytes of text, without control characters", kLongestRemark));
  }
  if (typed_number(number).size() < kFewestLetters)
    return fail("too few letters for a number", number, "mechane visits list shows the numbers; four letters may do");
  try {
    SQLite::Transaction transaction(connection_->db, SQLite::TransactionBehavior::IMMEDIATE);
    const std::vector<VisitSheet> found = connection_->read_now({.number = number});
    if (found.size() != 1) {
      return fail(found.empty() ? std::string("there is no visit of this number")
                                : fmt::format("{} visits begin so", found.size()),
                  number, "mechane visits list shows the numbers");
    }
    SQLite::Statement insert(connection_->db, "INSERT INTO remark VALUES (?, ?, ?, ?)");
    insert.bind(1, found.front().number);
    insert.bind(2, static_cast<std::int64_t>(found.front().remarks.size()));
    insert.bind(3, remark.minute);
    insert.bind(4, remark.text);
    insert.exec();
    transaction.commit();
    return found.front().number;
  } catch (const SQLite::Exception& e) {
    return tl::unexpected(explain_visits(e, file_, "writing a remark"));
  }
}

Expected<std::size_t> VisitFile::forget(const VisitChoice& choice) {
  const ChoiceQuery chosen(choice);
  if (!chosen.chooses()) return fail("nothing says what to forget", file_.string(), "name a visit, or --before DATE");
  try {
    const std::size_t removed = connection_->remove(chosen.after("DELETE FROM visit"),
                                                    [&](SQLite::Statement& statement) { chosen.bind(statement); });
    if (removed > 0) connection_->shrink();
    return removed;
  } catch (const SQLite::Exception& e) {
    return tl::unexpected(explain_visits(e, file_, "forgetting"));
  }
}

Expected<std::vector<VisitSheet>> VisitFile::cut_running(std::int64_t since, Trouble* trouble) {
  try {
    SQLite::Transaction transaction(connection_->db, SQLite::TransactionBehavior::IMMEDIATE);
    connection_->db.exec("UPDATE visit SET ending = 'cut' WHERE ending = 'running'");
    std::vector<VisitSheet> cut = connection_->read_now({.since = since});
    transaction.commit();
    std::erase_if(cut, [](const VisitSheet& sheet) { return sheet.ending != VisitEnding::cut; });
    return cut;
  } catch (const SQLite::Exception& e) {
    if (trouble != nullptr) *trouble = trouble_of(e);
    return tl::unexpected(explain_visits(e, file_, "reading it"));
  }
}

Expected<std::size_t> VisitFile::keep_within(std::int64_t before_minute, std::uint64_t max_bytes) {
  try {
    std::size_t removed = connection_->remove("DELETE FROM visit WHERE minute < ?",
                                              [&](SQLite::Statement& statement) { statement.bind(1, before_minute); });
    // A twentieth at a time: few rounds, and little more than must be.
    while (connection_->used_bytes() > max_bytes) {
      const std::size_t gone = connection_->remove(
          "DELETE FROM visit WHERE number IN (SELECT number FROM visit ORDER BY minute "
          "LIMIT (SELECT count(*) / 20 + 1 FROM visit))",
          [](SQLite::Statement&) {});
      if (gone == 0) break;
      removed += gone;
    }
    if (removed > 0) connection_->shrink();
    return removed;
  } catch (const SQLite::Exception& e) {
    return tl::unexpected(explain_visits(e, file_, "deleting old sheets"));
  }
}

Expected<fs::path> set_aside(const fs::path& file) {
  std::string when = minute_text(minute_now());
  std::erase_if(when, [](char c) { return c == ':' || c == '-'; });
  std::ranges::replace(when, ' ', '-');
  fs::path aside = file;
  aside += ".damaged-" + when;
  std::error_code code;
  for (int n = 2; fs::exists(aside, code); ++n)
    aside = file.string() + fmt::format(".damaged-{}-{}", when, n);
  fs::rename(file, aside, code);
  if (code) return fail("it cannot be moved away: " + code.message(), file.string(), "check the folder's rights");
  for (const char* beside : {"-wal", "-shm"}) {
    std::error_code ignored;  // mostly there is none
    fs::rename(file.string() + beside, aside.string() + beside, ignored);
  }
  return aside;
}

}  // namespace mechane::visits
