#include "server/database/sqlite_file.hpp"

#include <algorithm>
#include <vector>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

namespace mechane::database {
namespace {

SQLite::Column value_of(const SQLite::Database& db, const std::string& text) {
  SQLite::Statement query(db, text);
  (void)query.executeStep();
  return query.getColumn(0);
}

bool has_tables_of(const SQLite::Database& db, const Schema& schema) {
  std::vector<std::string> wanted(schema.statements.begin(), schema.statements.end());
  std::vector<std::string> found;
  SQLite::Statement rows(db, "SELECT coalesce(sql, '') FROM sqlite_schema WHERE name NOT LIKE 'sqlite_autoindex_%'");
  while (rows.executeStep() && found.size() <= wanted.size())
    found.push_back(rows.getColumn(0).getString());
  std::ranges::sort(wanted);
  std::ranges::sort(found);
  return wanted == found;
}

}  // namespace

Error explain(const SQLite::Exception& reason, const std::filesystem::path& file, const std::string& doing,
              const FileWords& words) {
  const auto error = [&](ErrorCode code, std::string what, std::string remedy) {
    return Error{code, std::move(what), file.string(), std::move(remedy)};
  };
  const auto and_then = [&](const std::string& remedy) {
    return words.after_a_failure.empty() ? remedy : remedy + "; " + words.after_a_failure;
  };
  switch (reason.getErrorCode()) {
    case SQLITE_NOTADB:
      return error(ErrorCode::damaged, words.not_of_this_kind + ", or its first bytes are damaged",
                   words.name_another + "; or, if it was one: " + words.begin_anew);
    case SQLITE_CORRUPT:
      return error(ErrorCode::damaged, fmt::format("{} is damaged ({})", words.name, reason.what()), words.begin_anew);
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH:
      return error(ErrorCode::io_failure, fmt::format("{}: no right to write {} or its folder", doing, words.name),
                   "check the rights of both");
    case SQLITE_CANTOPEN:
      return error(ErrorCode::io_failure, fmt::format("{}: the file cannot be opened", doing),
                   "check that its folder exists, and the rights of both");
    case SQLITE_FULL:
      return error(ErrorCode::io_failure, fmt::format("{}: the disk is full", doing),
                   and_then("make room on the disk"));
    case SQLITE_IOERR:
      return error(ErrorCode::io_failure,
                   fmt::format("{}: the disk failed ({})", doing, sqlite3_errstr(reason.getExtendedErrorCode())),
                   and_then("check the disk and its space"));
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return error(ErrorCode::busy, fmt::format("{}: another program is writing the file", doing),
                   "try again when that program is done");
    default:
      return error(ErrorCode::io_failure, fmt::format("{}: {}", doing, reason.what()),
                   "check the file and its disk; if the file is damaged: " + words.begin_anew);
  }
}

void throw_damaged(const std::string& what) {
  throw SQLite::Exception(what, SQLITE_CORRUPT);
}

void distrust(SQLite::Database& db) {
  sqlite3* const handle = db.getHandle();
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  db.exec("PRAGMA foreign_keys = ON; PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0");
}

std::int64_t pragma(const SQLite::Database& db, const char* name) {
  return value_of(db, fmt::format("PRAGMA {}", name)).getInt64();
}

bool has_tables(const SQLite::Database& db) {
  return value_of(db, "SELECT count(*) FROM sqlite_schema").getInt() != 0;
}

void make_tables(SQLite::Database& db, const Schema& schema) {
  const auto is_new = [&] { return pragma(db, "user_version") == 0 && !has_tables(db); };
  if (!is_new()) return;  // without having locked it
  SQLite::Transaction transaction(db, SQLite::TransactionBehavior::IMMEDIATE);
  if (!is_new()) return;
  for (const char* statement : schema.statements)
    db.exec(statement);
  db.exec(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", schema.application_id, schema.version));
  transaction.commit();
}

Expected<void> check(const SQLite::Database& db, const std::filesystem::path& file, const Schema& schema,
                     const FileWords& words) {
  const std::int64_t version = pragma(db, "user_version");
  if (pragma(db, "application_id") != schema.application_id) {
    return fail(ErrorCode::invalid_value, words.not_of_this_kind + " but another program's database", file.string(),
                words.name_another);
  }
  if (version > schema.version) {
    return fail(ErrorCode::wrong_version,
                fmt::format("a newer Mechane has written {} (format {}; this one reads {})", words.name, version,
                            schema.version),
                file.string(), "update Mechane on this machine");
  }
  if (version != schema.version || !has_tables_of(db, schema)) throw_damaged("its tables are not the expected ones");
  const std::string found = value_of(db, "PRAGMA quick_check(1)").getString();
  if (found != "ok") throw_damaged(found);
  return {};
}

}  // namespace mechane::database
