// `mechane visits`: what visitors did and said, for people.
#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>

namespace mechane::cli {

struct VisitsOptions {
  std::filesystem::path records = "out/records";  ///< the server's; the sheets are in it
  std::filesystem::path file;                     ///< or the sheets themselves
  std::string since;   ///< "2026-11-22" or "2026-11-22 09:40", UTC; only what began then or later
  std::string before;  ///< forget: what began earlier
  std::string scenario;
  std::string kiosk;
  std::string visit;          ///< show, remark, forget: its number, or the first letters of it
  std::string text;           ///< remark
  std::size_t last = 20;      ///< list: so many, the newest; 0: all
  std::filesystem::path csv;  ///< to be written beside the report
  std::filesystem::path svg;
  bool json = false;
};

/// The body of `mechane visits [VERB]`: "" (the report), list, show, remark or forget. Returns the exit status: 0; 1 where something is
/// wrong with the file, said in a line with its remedy; 2 for wrong arguments, a scenario or kiosk that no sheet knows among them. Any thread; no network.
[[nodiscard]] int run_visits(std::string_view verb, const VisitsOptions& options, std::ostream& out,
                             std::ostream& errors);

}  // namespace mechane::cli
