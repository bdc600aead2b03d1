#include "client-sdk/cli/visits.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <ostream>
#include <set>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "client-sdk/cli/content_text.hpp"
#include "client-sdk/cli/visit_plot.hpp"
#include "client-sdk/cli/visit_statistics.hpp"
#include "client-sdk/cli/visit_text.hpp"
#include "server/base/suggestion.hpp"
#include "server/visits/visit_file.hpp"

namespace mechane::cli {
namespace {

namespace fs = std::filesystem;
using visits::VisitChoice;
using visits::VisitFile;
using visits::VisitSheet;

constexpr int kWrongArguments = 2;

/// One run of a verb: where it speaks, and what it was told.
class VisitsCommand {
 public:
  VisitsCommand(const VisitsOptions& options, std::ostream& out, std::ostream& errors)
      : options_(options), out_(out), errors_(errors) {}

  int report();
  int list();
  int show();
  int remark();
  int forget();

 private:
  int failed(const Error& error, int status = 1) {
    fmt::print(errors_, "mechane visits: {}\n", shown(error.to_string()));
    return status;
  }
  [[nodiscard]] fs::path file() const {
    return options_.file.empty() ? options_.records / visits::kVisitFileName : options_.file;
  }
  /// What the options choose. Errors: not a date.
  [[nodiscard]] Expected<VisitChoice> choice() const;
  [[nodiscard]] Expected<std::vector<VisitSheet>> read(const VisitChoice& choice) const;
  /// Of report and list. Says what is wrong itself: then none, and the exit status.
  std::optional<std::vector<VisitSheet>> chosen_sheets(int& status);
  /// A name to choose by that no sheet has, where there are sheets.
  [[nodiscard]] std::optional<Error> unknown_name(std::span<const VisitSheet> all) const;
  int write(const fs::path& path, const std::string& text);

  const VisitsOptions& options_;
  std::ostream& out_;
  std::ostream& errors_;
};

Expected<VisitChoice> VisitsCommand::choice() const {
  VisitChoice choice{.scenario = options_.scenario, .kiosk = options_.kiosk, .number = options_.visit};
  for (const auto& [text, minute] :
       {std::pair(&options_.since, &choice.since), std::pair(&options_.before, &choice.before)}) {
    if (text->empty()) continue;
    const auto date = visits::minute_of_text(*text);
    if (!date) return tl::unexpected(date.error());
    *minute = *date;
  }
  return choice;
}

Expected<std::vector<VisitSheet>> VisitsCommand::read(const VisitChoice& choice) const {
  const auto opened = VisitFile::open(file(), VisitFile::Access::read);
  if (!opened) return tl::unexpected(opened.error());
  return opened->sheets(choice);
}

std::optional<Error> VisitsCommand::unknown_name(std::span<const VisitSheet> all) const {
  struct Filter {
    const char* what;
    const std::string& wanted;
    std::string VisitSheet::*of;
  };
  for (const Filter& filter : {Filter{"scenario", options_.scenario, &VisitSheet::scenario},
                               Filter{"kiosk", options_.kiosk, &VisitSheet::kiosk}}) {
    std::set<std::string> known;
    for (const VisitSheet& sheet : all)
      known.insert(sheet.*filter.of);
    if (filter.wanted.empty() || known.empty() || known.contains(filter.wanted)) continue;
    const std::vector<std::string> names(known.begin(), known.end());
    return Error{fmt::format("no sheet is of the {} '{}'", filter.what, filter.wanted), file().string(),
                 suggest(filter.wanted, names, "")};
  }
  return std::nullopt;
}

std::optional<std::vector<VisitSheet>> VisitsCommand::chosen_sheets(int& status) {
  const auto chosen = choice();
  if (!chosen) {
    status = failed(chosen.error(), kWrongArguments);
    return std::nullopt;
  }
  auto sheets = read(*chosen);
  // A name that is known may have no sheet in the time that was asked for.
  const auto all = sheets && sheets->empty() ? read({}) : Expected<std::vector<VisitSheet>>();
  if (!sheets || !all) {
    status = failed(!sheets ? sheets.error() : all.error());
    return std::nullopt;
  }
  if (const auto unknown = unknown_name(*all)) {
    status = failed(*unknown, kWrongArguments);
    return std::nullopt;
  }
  return std::move(*sheets);
}

int VisitsCommand::write(const fs::path& path, const std::string& text) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (!out) {
    return failed({fmt::format("the file cannot be written: {}", std::strerror(errno)), path.string(),
                   "check its folder, the rights and the disk's space"});
  }
  fmt::print(errors_, "wrote {}\n", path.string());
  return 0;
}

int VisitsCommand::report() {
  int status = 0;
  const auto sheets = chosen_sheets(status);
  if (!sheets) return status;
  const std::vector<ActivitySummary> activities = summarise(*sheets);
  out_ << (options_.json ? report_json(activities) : visits_report(activities));
  if (!options_.csv.empty()) status = std::max(status, write(options_.csv, visits_csv(*sheets)));
  if (!options_.svg.empty()) status = std::max(status, write(options_.svg, visits_svg(activities)));
  return status;
}

int VisitsCommand::list() {
  int status = 0;
  auto sheets = chosen_sheets(status);
  if (!sheets) return status;
  if (options_.last > 0 && sheets->size() > options_.last)
    sheets->erase(sheets->begin(), sheets->end() - static_cast<std::ptrdiff_t>(options_.last));
  out_ << (options_.json ? sheets_json(*sheets) : visits_list(*sheets));
  return 0;
}

int VisitsCommand::show() {
  const auto sheets = read({.number = options_.visit});
  if (!sheets) return failed(sheets.error());
  if (sheets->empty())
    return failed({"there is no visit of this number", options_.visit, "mechane visits list shows the numbers"});
  if (options_.json) {
    out_ << sheets_json(*sheets);
    return 0;
  }
  for (const VisitSheet& sheet : *sheets)
    out_ << (&sheet == sheets->data() ? "" : "\n") << visit_page(sheet);
  return 0;
}

int VisitsCommand::remark() {
  auto opened = VisitFile::open(file(), VisitFile::Access::write);
  if (!opened) return failed(opened.error());
  const auto number = opened->remark(options_.visit, {visits::minute_now(), options_.text});
  if (!number) return failed(number.error());
  fmt::print(out_, "{}: remark kept\n", *number);
  return 0;
}

int VisitsCommand::forget() {
  if (options_.visit.empty() == options_.before.empty()) {
    return failed({"say what to forget", "mechane visits forget", "name one visit, or --before DATE"}, kWrongArguments);
  }
  const auto chosen = choice();
  if (!chosen) return failed(chosen.error(), kWrongArguments);
  auto opened = VisitFile::open(file(), VisitFile::Access::write);
  if (!opened) return failed(opened.error());
  if (!options_.visit.empty()) {
    if (options_.visit.size() < 4)
      return failed({"too few letters for a number", options_.visit, "mechane visits list shows the numbers"});
    const auto sheets = opened->sheets({.number = options_.visit});
    if (!sheets) return failed(sheets.error());
    if (sheets->size() != 1) {
      return failed({sheets->empty() ? std::string("there is no visit of this number")
                                     : fmt::format("{} visits begin so", sheets->size()),
                     options_.visit, "mechane visits list shows the numbers"});
    }
  }
  const auto forgotten = opened->forget(*chosen);
  if (!forgotten) return failed(forgotten.error());
  fmt::print(out_, "{} {} forgotten\n", *forgotten, *forgotten == 1 ? "visit" : "visits");
  return 0;
}

}  // namespace

int run_visits(std::string_view verb, const VisitsOptions& options, std::ostream& out, std::ostream& errors) {
  VisitsCommand command(options, out, errors);
  if (verb == "list") return command.list();
  if (verb == "show") return command.show();
  if (verb == "remark") return command.remark();
  if (verb == "forget") return command.forget();
  return command.report();
}

}  // namespace mechane::cli
