// What Mechane's SQLite files have in common: how they are made and checked, and SQLite's reasons in words for people.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "server/base/error.hpp"

namespace SQLite {
class Database;
class Exception;
}  // namespace SQLite

namespace mechane::database {

/// How long a program waits for another one that writes the same file.
inline constexpr int kBusyTimeout_ms = 5000;

/// What a kind of file is called in messages, and what a person can do about it.
struct FileWords {
  std::string name;              ///< "the catalogue"
  std::string not_of_this_kind;  ///< "this is not a catalogue"
  std::string name_another;      ///< remedy: "name another file with --catalogue"
  std::string begin_anew;        ///< remedy for a damaged file
  std::string after_a_failure;   ///< what a failed write left behind; empty: nothing to say
};

/// The tables of a kind of file. `application_id` is in the file's head, where `file` and sqlite3 show it.
struct Schema {
  int application_id = 0;
  int version = 0;
  std::span<const char* const> statements;  ///< CREATE TABLE and CREATE INDEX, each as SQLite keeps it
};

/// SQLite's reason in words for a person. `doing`: "writing it". The code is damaged (also for a file that is not a database), busy, or
/// else io_failure.
[[nodiscard]] Error explain(const SQLite::Exception& reason, const std::filesystem::path& file,
                            const std::string& doing, const FileWords& words);

/// Throws a reason that explain() calls damage: for values in a file that Mechane never writes.
[[noreturn]] void throw_damaged(const std::string& what);

// These throw SQLite::Exception.

/// For a file that may come from anywhere: no code in its schema is run, and a page with wrong cell sizes is noticed. Call it first.
void distrust(SQLite::Database& db);
[[nodiscard]] std::int64_t pragma(const SQLite::Database& db, const char* name);
[[nodiscard]] bool has_tables(const SQLite::Database& db);
/// Makes the tables where the file is new, in one transaction: of two programs that make the same file, one finds it already made.
void make_tables(SQLite::Database& db, const Schema& schema);
/// Checks that the file is of this kind and version, that its tables are declared word for word as in the schema (so that no other
/// declaration is ever run), and that its pages are whole. Errors: invalid_value (another program's file), wrong_version (a newer
/// Mechane's). Damage is thrown.
[[nodiscard]] Expected<void> check(const SQLite::Database& db, const std::filesystem::path& file, const Schema& schema,
                                   const FileWords& words);

}  // namespace mechane::database
