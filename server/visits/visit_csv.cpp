#include "server/visits/visit_csv.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace mechane::visits {
namespace {

/// One field of a CSV line.
std::string field(std::string text) {
  if (!text.empty() && std::string_view("=+-@\t\r\n").find(text.front()) != std::string_view::npos)
    text.insert(text.begin(), '\'');
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string answer_value(const RecordedAnswer& answer) {
  return answer.marks > 0 ? fmt::format("{}", answer.mark) : answer.value;
}

/// The columns that not every visit has, by their headings.
using Cells = std::map<std::string, std::string>;

Cells cells_of(const VisitRecord& record) {
  Cells cells;
  std::map<std::string, double> times;
  for (const RecordedStep& step : record.steps)
    times[step.name] += step.duration_s;
  for (const auto& [name, time_s] : times)
    cells[fmt::format("{} {} s", record.activity, name)] = fmt::format("{:.3f}", time_s);
  for (const RecordedAnswer& answer : record.answers)
    cells[fmt::format("{} {}: {}", record.activity, word_of(answer.when), answer.question)] = answer_value(answer);
  return cells;
}

std::vector<std::string> fixed_cells(const VisitRecord& record) {
  const auto steps = [&](const auto& fits) { return fmt::format("{}", std::ranges::count_if(record.steps, fits)); };
  std::vector<std::string> cells{record.number,
                                 minute_text(record.minute),
                                 record.kiosk,
                                 record.scenario,
                                 record.scenario_hash,
                                 record.activity,
                                 record.language,
                                 std::string(word_of(record.ending)),
                                 record.done_alone() ? "yes" : "no",
                                 record.from_start ? "yes" : "no",
                                 fmt::format("{:.3f}", record.duration_s),
                                 fmt::format("{}", record.hands),
                                 record.went_on_to,
                                 steps([](const RecordedStep& s) { return s.hint_shown; }),
                                 steps([](const RecordedStep& s) { return s.ending == StepEnding::timed_out; }),
                                 steps([](const RecordedStep& s) { return s.ending == StepEnding::skipped; })};
  for (std::size_t k = 0; k < kMistakeKinds; ++k)
    cells.push_back(fmt::format("{}", record.count_of(static_cast<MistakeKind>(k))));
  std::vector<std::string> remarks;
  for (const RecordedRemark& remark : record.remarks)
    remarks.push_back(remark_line(remark));
  cells.push_back(fmt::format("{}", fmt::join(remarks, "\n")));
  return cells;
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells)
    line.append(&cell == cells.data() ? "" : ",").append(field(cell));
  return line + "\r\n";
}

}  // namespace

std::string visits_csv(std::span<const VisitRecord> records) {
  std::vector<std::string> head{"visit",      "began (UTC)", "kiosk",      "scenario",   "scenario hash", "activity",
                                "language",   "ending",      "done alone", "from start", "duration s",    "hands",
                                "went on to", "hints",       "timed out",  "skipped"};
  for (std::size_t k = 0; k < kMistakeKinds; ++k)
    head.emplace_back(word_of(static_cast<MistakeKind>(k)));
  head.emplace_back("remarks");
  Cells columns;
  for (const VisitRecord& record : records)
    columns.merge(cells_of(record));
  for (const auto& [name, unused] : columns)
    head.push_back(name);
  std::string csv = csv_line(head);
  for (const VisitRecord& record : records) {
    std::vector<std::string> line = fixed_cells(record);
    const Cells cells = cells_of(record);
    for (const auto& [name, unused] : columns) {
      const auto cell = cells.find(name);
      line.push_back(cell == cells.end() ? "" : cell->second);
    }
    csv += csv_line(line);
  }
  return csv;
}

}  // namespace mechane::visits
