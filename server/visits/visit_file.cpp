#include "server/visits/visit_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <map>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include "server/base/markup.hpp"
#include "server/base/utf8.hpp"
#include "server/database/sqlite_file.hpp"

namespace mechane::visits {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFewestLetters = 4;
constexpr std::int64_t kLastMinute = 253402300799 / 60;  // of the year 9999

/// Without rowids: the visits lie in the order of their random numbers, so that the file does not show in which order they came.
constexpr std::array<const char*, 6> kVisitTables{
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
    "CREATE INDEX visit_minute ON visit (minute)",
};
constexpr database::Schema kVisitSchema{.application_id = 0x4d454356,  // "MECV"
                                        .version = 1,
                                        .statements = kVisitTables};

database::FileWords visit_words() {
  return {.name = "the file of visits",
          .not_of_this_kind = "this is not a file of visits",
          .name_another = "name another file with --file",
          .begin_anew = "move the file away: the server begins a new one; sqlite3's .recover may save some of the old",
          .after_a_failure = ""};
}

tl::unexpected<Error> explain_visits(const SQLite::Exception& e, const fs::path& file, const std::string& doing) {
  return tl::unexpected(database::explain(e, file, doing, visit_words()));
}

/// A number that a person typed, as the file has it: "K7M2 9QXD" is "k7m2-9qxd".
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

/// The file's name as a URI, to which SQLite's options can be added.
std::string uri_of(const fs::path& file) {
  return "file:" + escape_percent(fs::absolute(file).string(), "/");
}

/// The WHERE of a query for a choice.
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
  [[nodiscard]] std::string after(const std::string& head) const {
    std::string query = head + " WHERE 1" + text_;
    if (choice_.newest > 0)
      query += fmt::format(" AND number IN (SELECT number FROM visit WHERE 1{} ORDER BY minute DESC, number LIMIT {})",
                           text_, choice_.newest);
    return query;
  }
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

/// One row. A value that Mechane never writes means that the file is damaged.
struct Row {
  SQLite::Statement& statement;
  [[nodiscard]] std::string text(int column) const { return statement.getColumn(column).getString(); }
  [[nodiscard]] std::int64_t whole(int column, std::int64_t low, std::int64_t high) const {
    const std::int64_t value = statement.getColumn(column).getInt64();
    if (value < low || value > high)
      database::throw_damaged(fmt::format("{} is {}", statement.getColumnName(column), value));
    return value;
  }
  [[nodiscard]] double seconds(int column) const {
    const double value = statement.getColumn(column).getDouble();
    if (!(value >= 0 && value <= 1e9))
      database::throw_damaged(fmt::format("{} is {}", statement.getColumnName(column), value));
    return value;
  }
  template <class Enum>
  [[nodiscard]] Enum word(int column, std::optional<Enum> (*of)(std::string_view)) const {
    const auto value = of(text(column));
    if (!value) database::throw_damaged(fmt::format("{} is '{}'", statement.getColumnName(column), text(column)));
    return *value;
  }
};

VisitRecord record_of(const Row& row) {
  VisitRecord record;
  record.number = row.text(0);
  if (!is_number(record.number)) database::throw_damaged("not a visit's number: " + record.number);
  record.kiosk = row.text(1);
  record.scenario = row.text(2);
  record.scenario_hash = row.text(3);
  record.activity = row.text(4);
  record.language = row.text(5);
  record.minute = row.whole(6, 0, kLastMinute);
  record.duration_s = row.seconds(7);
  record.from_start = row.whole(8, 0, 1) != 0;
  record.hands = static_cast<std::uint32_t>(row.whole(9, 0, 1000));
  record.ending = row.word(10, visit_ending_of);
  record.went_on_to = row.text(11);
  record.notes_lost = static_cast<std::uint32_t>(row.whole(12, 0, 0xffffffff));
  return record;
}

RecordedAnswer answer_of(const Row& row) {
  RecordedAnswer answer;
  answer.question = row.text(1);
  answer.when = row.word(2, answer_time_of);
  answer.value = row.text(3);
  answer.marks = static_cast<int>(row.whole(5, 0, 1000));
  answer.mark = static_cast<int>(row.whole(4, answer.marks > 0 ? 1 : 0, answer.marks));
  if (!row.statement.isColumnNull(6)) answer.right = row.whole(6, 0, 1) != 0;
  return answer;
}

}  // namespace

/// The database. The functions of VisitFile catch SQLite's exceptions.
struct VisitFile::Connection {
  Connection(const std::string& name, int flags) : db(name, flags, database::kBusyTimeout_ms) {
    database::distrust(db);
    db.exec("PRAGMA secure_delete = ON");  // forgotten visits are overwritten with zeros
  }

  static std::unique_ptr<Connection> open(const fs::path& file, Access access);

  void make_tables() {
    // Has an effect only before the file has any page.
    if (!database::has_tables(db)) db.exec("PRAGMA auto_vacuum = INCREMENTAL");
    database::make_tables(db, kVisitSchema);
  }
  void write_ahead() { db.exec("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL"); }

  void write_head(const VisitRecord& record, const char* sql);
  void write_rows(const VisitRecord& record);
  /// Call it in a transaction, so that all tables are of the same moment.
  [[nodiscard]] std::vector<VisitRecord> read_now(const VisitChoice& choice) const;
  void read_rows(const VisitChoice& choice, std::map<std::string, VisitRecord>& by_number) const;
  std::size_t remove(const std::string& query, const std::function<void(SQLite::Statement&)>& bind);
  void shrink();
  [[nodiscard]] std::uint64_t used_bytes() const {
    const std::int64_t pages = database::pragma(db, "page_count") - database::pragma(db, "freelist_count");
    return static_cast<std::uint64_t>(pages * database::pragma(db, "page_size"));
  }

  mutable SQLite::Database db;
};

/// SQLite makes its journal before it reads. Where we may not write to the folder or disk, a file that nobody writes is read without one.
std::unique_ptr<VisitFile::Connection> VisitFile::Connection::open(const fs::path& file, Access access) {
  if (access != Access::read) {
    const int made = access == Access::write_new ? SQLite::OPEN_CREATE : 0;
    return std::make_unique<Connection>(file.string(), SQLite::OPEN_READWRITE | made);
  }
  try {
    auto connection = std::make_unique<Connection>(file.string(), SQLite::OPEN_READONLY);
    (void)database::has_tables(connection->db);  // the first read
    return connection;
  } catch (const SQLite::Exception& e) {
    std::error_code code;
    const bool at_rest = !fs::exists(file.string() + "-wal", code);
    if (!at_rest || (e.getErrorCode() != SQLITE_CANTOPEN && e.getErrorCode() != SQLITE_READONLY)) throw;
    return std::make_unique<Connection>(uri_of(file) + "?immutable=1", SQLite::OPEN_READONLY | SQLite::OPEN_URI);
  }
}

void VisitFile::Connection::write_head(const VisitRecord& record, const char* sql) {
  SQLite::Statement head(db, sql);
  int column = 0;
  for (const std::string& text :
       {record.number, record.kiosk, record.scenario, record.scenario_hash, record.activity, record.language})
    head.bind(++column, text);
  head.bind(++column, record.minute);
  head.bind(++column, record.duration_s);
  head.bind(++column, record.from_start ? 1 : 0);
  head.bind(++column, record.hands);
  head.bind(++column, std::string(word_of(record.ending)));
  head.bind(++column, record.went_on_to);
  head.bind(++column, record.notes_lost);
  head.exec();
}

void VisitFile::Connection::write_rows(const VisitRecord& record) {
  const auto insert = [&](const char* sql, std::size_t count, const auto& bind) {
    SQLite::Statement row(db, sql);
    for (std::size_t i = 0; i < count; ++i) {
      row.bind(1, record.number);
      row.bind(2, static_cast<std::int64_t>(i));
      bind(row, i);
      row.exec();
      row.reset();
    }
  };
  insert("INSERT INTO step VALUES (?, ?, ?, ?, ?, ?, ?)", record.steps.size(),
         [&](SQLite::Statement& row, std::size_t i) {
           const RecordedStep& step = record.steps[i];
           row.bind(3, step.name);
           row.bind(4, step.duration_s);
           row.bind(5, std::string(word_of(step.ending)));
           row.bind(6, step.hint_shown ? 1 : 0);
           row.bind(7, step.whole ? 1 : 0);
         });
  insert("INSERT INTO mistake VALUES (?, ?, ?, ?, ?)", record.mistakes.size(),
         [&](SQLite::Statement& row, std::size_t i) {
           const RecordedMistake& mistake = record.mistakes[i];
           row.bind(3, std::string(word_of(mistake.kind)));
           row.bind(4, mistake.subject);
           row.bind(5, mistake.count);
         });
  insert("INSERT INTO answer VALUES (?, ?, ?, ?, ?, ?, ?, ?)", record.answers.size(),
         [&](SQLite::Statement& row, std::size_t i) {
           const RecordedAnswer& answer = record.answers[i];
           row.bind(3, answer.question);
           row.bind(4, std::string(word_of(answer.when)));
           row.bind(5, answer.value);
           row.bind(6, answer.mark);
           row.bind(7, answer.marks);
           row.bind(8);
           if (answer.right) row.bind(8, *answer.right ? 1 : 0);
         });
}

std::vector<VisitRecord> VisitFile::Connection::read_now(const VisitChoice& choice) const {
  const ChoiceQuery chosen(choice);
  std::map<std::string, VisitRecord> by_number;
  SQLite::Statement heads(db, chosen.after("SELECT * FROM visit"));
  chosen.bind(heads);
  while (heads.executeStep()) {
    VisitRecord record = record_of({heads});
    by_number.emplace(record.number, std::move(record));
  }
  read_rows(choice, by_number);
  std::vector<VisitRecord> records;
  records.reserve(by_number.size());
  for (auto& [number, record] : by_number)
    records.push_back(std::move(record));
  std::ranges::stable_sort(records, {}, &VisitRecord::minute);
  return records;
}

void VisitFile::Connection::read_rows(const VisitChoice& choice, std::map<std::string, VisitRecord>& by_number) const {
  const ChoiceQuery chosen(choice);
  const auto each = [&](const std::string& columns, const char* table, const auto& use) {
    SQLite::Statement rows(db, fmt::format("SELECT {} FROM {} WHERE visit IN ({}) ORDER BY visit, place", columns,
                                           table, chosen.after("SELECT number FROM visit")));
    chosen.bind(rows);
    while (rows.executeStep()) {
      const auto record = by_number.find(rows.getColumn(0).getString());
      if (record != by_number.end()) use(record->second, Row{rows});
    }
  };
  each("visit, name, duration_s, ending, hint_shown, whole", "step", [](VisitRecord& record, const Row& row) {
    record.steps.push_back(
        {row.text(1), row.seconds(2), row.word(3, step_ending_of), row.whole(4, 0, 1) != 0, row.whole(5, 0, 1) != 0});
  });
  each("visit, kind, subject, count", "mistake", [](VisitRecord& record, const Row& row) {
    record.mistakes.push_back(
        {row.word(1, mistake_kind_of), row.text(2), static_cast<std::uint32_t>(row.whole(3, 0, 1'000'000))});
  });
  each("visit, question, asked, value, mark, marks, is_right", "answer",
       [](VisitRecord& record, const Row& row) { record.answers.push_back(answer_of(row)); });
  each("visit, minute, text", "remark", [](VisitRecord& record, const Row& row) {
    record.remarks.push_back({row.whole(1, 0, kLastMinute), row.text(2)});
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

/// Gives free pages back to the disk, and empties the journal, where forgotten visits would stay readable.
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

Expected<VisitFile> VisitFile::open(const fs::path& file, Access access) {
  std::error_code code;
  const bool there = fs::exists(file, code);
  if (!there && access != Access::write_new) {
    return fail(ErrorCode::not_found, "there is no file of visits", file.string(),
                "name the server's folder of records with --records, or a file with --file");
  }
  if (there && !fs::is_regular_file(file, code)) {
    return fail(ErrorCode::invalid_value, "this is not a file of visits but a folder or a device", file.string(),
                "name a file with --file");
  }
  try {
    auto connection = Connection::open(file, access);
    if (access == Access::write_new) connection->make_tables();
    // Observers are in the server's group; visits are nobody else's business. SQLite gives its files beside it the same rights.
    if (!there) fs::permissions(file, fs::perms(0660), code);
    if (auto ours = database::check(connection->db, file, kVisitSchema, visit_words()); !ours)
      return tl::unexpected(ours.error());
    if (access != Access::read) connection->write_ahead();
    return VisitFile(file, std::move(connection));
  } catch (const SQLite::Exception& e) {
    return explain_visits(e, file, "opening it");
  }
}

Expected<bool> VisitFile::put(const VisitRecord& record, bool is_new) {
  try {
    SQLite::Transaction transaction(connection_->db, SQLite::TransactionBehavior::IMMEDIATE);
    if (is_new) {
      connection_->write_head(record, "INSERT INTO visit VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    } else {
      connection_->write_head(
          record,
          "UPDATE visit SET kiosk = ?2, scenario = ?3, scenario_hash = ?4, activity = ?5, language = ?6, minute = ?7, "
          "duration_s = ?8, from_start = ?9, hands = ?10, ending = ?11, went_on_to = ?12, notes_lost = ?13 "
          "WHERE number = ?1");
      if (connection_->db.getChanges() == 0) return false;
      for (const char* table : {"step", "mistake", "answer"}) {
        SQLite::Statement forget(connection_->db, fmt::format("DELETE FROM {} WHERE visit = ?", table));
        forget.bind(1, record.number);
        forget.exec();
      }
    }
    connection_->write_rows(record);
    transaction.commit();
    return true;
  } catch (const SQLite::Exception& e) {
    return explain_visits(e, file_, "writing a visit");
  }
}

Expected<std::vector<VisitRecord>> VisitFile::records(const VisitChoice& choice) const {
  try {
    SQLite::Transaction transaction(connection_->db);  // all tables of the same moment
    return connection_->read_now(choice);
  } catch (const SQLite::Exception& e) {
    return explain_visits(e, file_, "reading it");
  }
}

Expected<std::set<std::string>> VisitFile::numbers() const {
  try {
    std::set<std::string> numbers;
    SQLite::Statement rows(connection_->db, "SELECT number FROM visit");
    while (rows.executeStep())
      numbers.insert(rows.getColumn(0).getString());
    return numbers;
  } catch (const SQLite::Exception& e) {
    return explain_visits(e, file_, "reading it");
  }
}

Expected<std::size_t> VisitFile::count() const {
  try {
    return static_cast<std::size_t>(connection_->db.execAndGet("SELECT count(*) FROM visit").getInt64());
  } catch (const SQLite::Exception& e) {
    return explain_visits(e, file_, "reading it");
  }
}

Expected<std::string> VisitFile::remark(const std::string& number, const RecordedRemark& remark) {
  if (remark.text.empty() || remark.text.size() > kLongestRemark ||
      std::ranges::any_of(remark.text, is_control_in_lines)) {
    const bool too_long = remark.text.size() > kLongestRemark;
    return fail(too_long ? ErrorCode::too_large : ErrorCode::invalid_value,
                fmt::format("this remark of {} bytes cannot be kept", remark.text.size()), "visit " + number,
                fmt::format("write 1 to {} bytes of text, without control characters", kLongestRemark));
  }
  if (typed_number(number).size() < kFewestLetters)
    return fail(
        ErrorCode::invalid_value, "the number has too few letters", number,
        fmt::format("give at least its first {} letters; 'mechane visits list' shows the numbers", kFewestLetters));
  try {
    SQLite::Transaction transaction(connection_->db, SQLite::TransactionBehavior::IMMEDIATE);
    const std::vector<VisitRecord> found = connection_->read_now({.number = number});
    if (found.size() != 1) {
      return found.empty() ? fail(ErrorCode::unknown_name, "there is no visit with this number", number,
                                  "'mechane visits list' shows the numbers")
                           : fail(ErrorCode::conflict, fmt::format("{} visits begin with this number", found.size()),
                                  number, "give more of its letters; 'mechane visits list' shows the numbers");
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
    return explain_visits(e, file_, "writing a remark");
  }
}

Expected<std::size_t> VisitFile::forget(const VisitChoice& choice) {
  const ChoiceQuery chosen(choice);
  if (!chosen.chooses()) {
    return fail(ErrorCode::missing, "nothing says which visits to forget", file_.string(),
                "name a visit, or give --before DATE");
  }
  try {
    const std::size_t removed = connection_->remove(chosen.after("DELETE FROM visit"),
                                                    [&](SQLite::Statement& statement) { chosen.bind(statement); });
    if (removed > 0) connection_->shrink();
    return removed;
  } catch (const SQLite::Exception& e) {
    return explain_visits(e, file_, "forgetting");
  }
}

Expected<std::vector<VisitRecord>> VisitFile::cut_running(std::int64_t since) {
  try {
    SQLite::Transaction transaction(connection_->db, SQLite::TransactionBehavior::IMMEDIATE);
    connection_->db.exec("UPDATE visit SET ending = 'cut' WHERE ending = 'running'");
    std::vector<VisitRecord> cut = connection_->read_now({.since = since});
    transaction.commit();
    std::erase_if(cut, [](const VisitRecord& record) { return record.ending != VisitEnding::cut; });
    return cut;
  } catch (const SQLite::Exception& e) {
    return explain_visits(e, file_, "reading it");
  }
}

Expected<std::size_t> VisitFile::keep_within(std::int64_t before_minute, std::uint64_t max_bytes) {
  try {
    std::size_t removed = connection_->remove("DELETE FROM visit WHERE minute < ?",
                                              [&](SQLite::Statement& statement) { statement.bind(1, before_minute); });
    // A twentieth at a time: that takes few rounds, and deletes little more than needed.
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
    return explain_visits(e, file_, "deleting old visits");
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
  if (code) {
    return fail(ErrorCode::io_failure, "the file cannot be moved away: " + code.message(), file.string(),
                "check the folder's rights");
  }
  for (const char* beside : {"-wal", "-shm"}) {
    std::error_code ignored;  // mostly there is no such file
    fs::rename(file.string() + beside, aside.string() + beside, ignored);
  }
  return aside;
}

}  // namespace mechane::visits
