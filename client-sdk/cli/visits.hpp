// `mechane visits`: what visitors did and said, for people.
#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>

namespace mechane::cli {

struct VisitsOptions {
  std::filesystem::path records = "out/records";  ///< the server's folder; the file of visits is in it
  std::filesystem::path file;                     ///< or the file itself
  std::filesystem::path remarks;                  ///< a console's file of remarks, to be shown too; empty: none
  std::string since;   ///< "2026-11-22" or "2026-11-22 09:40", UTC; only what began then or later
  std::string before;  ///< forget: what began earlier
  std::string scenario;
  std::string kiosk;
  std::string visit;          ///< show, remark, forget: its number, or the first letters of it
  std::string text;           ///< remark
  std::size_t last = 20;      ///< list: the number of newest visits; 0: all
  std::filesystem::path csv;  ///< a file to be written in addition to the report
  std::filesystem::path svg;
  bool json = false;
};

/// The body of `mechane visits [VERB]`: "" (the report), list, show, remark or forget. Returns the exit status: 0; 1 if
/// something is wrong with the file, with a line and a remedy; 2 for wrong arguments, including a scenario or kiosk
/// that no visit has. Any thread; no network.
[[nodiscard]] int run_visits(std::string_view verb, const VisitsOptions& options, std::ostream& out,
                             std::ostream& errors);

}  // namespace mechane::cli
