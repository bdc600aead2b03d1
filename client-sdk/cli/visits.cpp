#include "client-sdk/cli/visits.hpp"

#include <algorithm>
#include <ostream>
#include <set>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "client-sdk/cli/content_text.hpp"
#include "client-sdk/cli/visit_plot.hpp"
#include "client-sdk/cli/visit_text.hpp"
#include "server/base/suggestion.hpp"
#include "server/base/whole_file.hpp"
#include "server/visits/remark_book.hpp"
#include "server/visits/visit_csv.hpp"
#include "server/visits/visit_file.hpp"
#include "server/visits/visit_statistics.hpp"

namespace mechane::cli {
namespace {

namespace fs = std::filesystem;
using visits::VisitChoice;
using visits::VisitFile;
using visits::VisitRecord;

constexpr int kWrongArguments = 2;

/// One run of a verb, with its options and output streams.
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
  /// The visits that the options choose. Errors: not a date.
  [[nodiscard]] Expected<VisitChoice> choice() const;
  [[nodiscard]] Expected<std::vector<VisitRecord>> read(const VisitChoice& choice) const;
  /// The visits for report and list. On an error, prints it, sets `status` and returns none.
  std::optional<std::vector<VisitRecord>> chosen_records(int& status);
  /// The error for a scenario or kiosk that no visit has, if there are visits at all.
  [[nodiscard]] std::optional<Error> unknown_name(std::span<const VisitRecord> all) const;
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

Expected<std::vector<VisitRecord>> VisitsCommand::read(const VisitChoice& choice) const {
  const auto opened = VisitFile::open(file(), VisitFile::Access::read);
  if (!opened) return tl::unexpected(opened.error());
  auto records = opened->records(choice);
  if (!records || options_.remarks.empty()) return records;
  if (std::error_code code; !fs::exists(options_.remarks, code)) {
    return fail(ErrorCode::not_found, "the file of remarks does not exist", options_.remarks.string(),
                "name remarks.json in the gateway's folder (--state)");
  }
  const auto book = visits::RemarkBook::open(options_.remarks);
  if (!book) return tl::unexpected(book.error());
  book->put_into(*records);
  return records;
}

std::optional<Error> VisitsCommand::unknown_name(std::span<const VisitRecord> all) const {
  struct Filter {
    const char* what;
    const std::string& wanted;
    std::string VisitRecord::*of;
  };
  for (const Filter& filter : {Filter{"scenario", options_.scenario, &VisitRecord::scenario},
                               Filter{"kiosk", options_.kiosk, &VisitRecord::kiosk}}) {
    std::set<std::string> known;
    for (const VisitRecord& record : all)
      known.insert(record.*filter.of);
    if (filter.wanted.empty() || known.empty() || known.contains(filter.wanted)) continue;
    const std::vector<std::string> names(known.begin(), known.end());
    return Error{ErrorCode::unknown_name, fmt::format("no visit has the {} '{}'", filter.what, filter.wanted),
                 file().string(), suggest(filter.wanted, names, "")};
  }
  return std::nullopt;
}

std::optional<std::vector<VisitRecord>> VisitsCommand::chosen_records(int& status) {
  const auto chosen = choice();
  if (!chosen) {
    status = failed(chosen.error(), kWrongArguments);
    return std::nullopt;
  }
  auto records = read(*chosen);
  // A known name may have no visit in the requested time.
  const auto all = records && records->empty() ? read({}) : Expected<std::vector<VisitRecord>>();
  if (!records || !all) {
    status = failed(!records ? records.error() : all.error());
    return std::nullopt;
  }
  if (const auto unknown = unknown_name(*all)) {
    status = failed(*unknown, kWrongArguments);
    return std::nullopt;
  }
  return std::move(*records);
}

int VisitsCommand::write(const fs::path& path, const std::string& text) {
  if (auto ok = write_whole(path, std::as_bytes(std::span(text)), WholeFile::document); !ok) return failed(ok.error());
  fmt::print(errors_, "wrote {}\n", path.string());
  return 0;
}

int VisitsCommand::report() {
  int status = 0;
  const auto records = chosen_records(status);
  if (!records) return status;
  const std::vector<visits::ActivitySummary> activities = summarise(*records);
  out_ << (options_.json ? report_json(activities) : visits_report(activities));
  if (!options_.csv.empty()) status = std::max(status, write(options_.csv, visits::visits_csv(*records)));
  if (!options_.svg.empty()) status = std::max(status, write(options_.svg, visits_svg(activities)));
  return status;
}

int VisitsCommand::list() {
  int status = 0;
  auto records = chosen_records(status);
  if (!records) return status;
  if (options_.last > 0 && records->size() > options_.last)
    records->erase(records->begin(), records->end() - static_cast<std::ptrdiff_t>(options_.last));
  out_ << (options_.json ? visits_json(*records) : visits_list(*records));
  return 0;
}

int VisitsCommand::show() {
  const auto records = read({.number = options_.visit});
  if (!records) return failed(records.error());
  if (records->empty())
    return failed({ErrorCode::unknown_name, "there is no visit with this number", options_.visit,
                   "'mechane visits list' shows the numbers"});
  if (options_.json) {
    out_ << visits_json(*records);
    return 0;
  }
  for (const VisitRecord& record : *records)
    out_ << (&record == records->data() ? "" : "\n") << visit_page(record);
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
    return failed({options_.visit.empty() ? ErrorCode::missing : ErrorCode::conflict, "it is not clear what to delete",
                   "mechane visits forget", "give either one visit or --before DATE"},
                  kWrongArguments);
  }
  const auto chosen = choice();
  if (!chosen) return failed(chosen.error(), kWrongArguments);
  auto opened = VisitFile::open(file(), VisitFile::Access::write);
  if (!opened) return failed(opened.error());
  if (!options_.visit.empty()) {
    if (options_.visit.size() < 4)
      return failed({ErrorCode::invalid_value, "the number has fewer than four letters", options_.visit,
                     "'mechane visits list' shows the numbers"});
    const auto records = opened->records({.number = options_.visit});
    if (!records) return failed(records.error());
    if (records->size() != 1) {
      return failed({records->empty() ? ErrorCode::unknown_name : ErrorCode::conflict,
                     records->empty() ? std::string("there is no visit with this number")
                                      : fmt::format("the numbers of {} visits begin like this", records->size()),
                     options_.visit, "'mechane visits list' shows the numbers"});
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
