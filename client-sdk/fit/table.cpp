#include "client-sdk/fit/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "server/base/utf8.hpp"

namespace mechane::fit {
namespace {

constexpr std::size_t kNameColumns = 14;

/// Splits a text into characters, each a string of its own; '?' replaces what is not printable UTF-8.
std::vector<std::string> characters(std::string_view text) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text.substr(i));
    const bool good = length != 0 && !is_control(text.substr(i, length));
    out.emplace_back(good ? std::string(text.substr(i, length)) : "?");
    i += good ? length : 1;
  }
  return out;
}

/// Taper along x and y, bend from end to end: ".3 -.2 90°"; "-" for none.
std::string shape_text(const PartSummary& part) {
  const auto tenths = [](double value) {
    std::string text = fmt::format("{:.1f}", value);
    if (const auto zero = text.find("0."); zero <= 1) text.erase(zero, 1);
    return text;
  };
  std::string text;
  if (part.taper_x != 0 || part.taper_y != 0) text = tenths(part.taper_x) + " " + tenths(part.taper_y);
  if (std::abs(part.bend_deg) >= 0.5) text += fmt::format("{}{:.0f}°", text.empty() ? "" : " ", part.bend_deg);
  return text.empty() ? "-" : text;
}

/// " .4  .6  2.1": mean, RMS, max.
std::string percents(const PartSummary& part) {
  const auto one = [](double pct) { return pct >= 9.95 ? fmt::format("{:.0f}", pct) : fmt::format("{:.1f}", pct); };
  return fmt::format("{} {:>3} {:>4}", one(part.fit_mean_pct), one(part.fit_rms_pct), one(part.fit_max_pct));
}

std::string count_text(std::size_t count) {
  if (count < 100'000) return fmt::format("{}", count);
  return count < 10'000'000 ? fmt::format("{}k", count / 1000) : fmt::format("{}M", count / 1'000'000);
}

std::string kilobytes(std::size_t bytes) {
  return bytes < 100'000 ? fmt::format("{:.1f}", static_cast<double>(bytes) / 1000) : fmt::format("{}", bytes / 1000);
}

/// The columns after the name, right-aligned; the widths include the gaps and add up to kTableColumns.
using Cells = std::array<std::string, 10>;
constexpr std::array<std::size_t, 10> kWidths{6, 15, 8, 11, 13, 10, 5, 6, 6, 6};

std::string row(std::string_view name, const Cells& cells) {
  std::string line = fitted_text(name, kNameColumns);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t room = kWidths[i] - 1;
    const std::size_t length = characters(cells[i]).size();
    line += std::string(1 + (length < room ? room - length : 0), ' ') + fitted_text(cells[i], std::min(length, room));
  }
  return line + "\n";
}

std::string part_row(const PartSummary& part) {
  return row(part.name,
             {count_text(part.triangles),
              fmt::format("{} {} {}", mm_text(part.axes_mm.x()), mm_text(part.axes_mm.y()), mm_text(part.axes_mm.z())),
              fmt::format("{:.1f} {:.1f}", part.e1, part.e2), shape_text(part), percents(part), part.map_kind,
              kilobytes(part.map_bytes), mm_text(part.depth_error_p50_mm), mm_text(part.depth_error_p99_mm),
              count_text(part.samples)});
}

}  // namespace

std::string summary_table(const Summary& summary) {
  std::string rule;
  for (std::size_t i = 0; i < kTableColumns; ++i)
    rule += "─";
  rule += "\n";
  std::string out = row("", {"", "semi-axes", "expo-", "taper", "fit error, %", "", "map", "depth", "error", "sam-"});
  out += row("part", {"tris", "mm", "nents", "bend", "mean rms max", "map", "KB", "p50mm", "p99mm", "ples"});
  out += rule;
  for (const PartSummary& part : summary.parts)
    out += part_row(part);
  out += rule;
  const PartSummary& worst = summary.parts[summary.worst_part];
  out += fmt::format("{} part{}, {} triangles, {} samples; maps {}, file {}; built in {:.1f} s\n", summary.parts.size(),
                     summary.parts.size() == 1 ? "" : "s", summary.triangles, summary.samples,
                     bytes_text(summary.map_bytes), bytes_text(summary.file_bytes), summary.build_s);
  const double diagonal_pct = 100 * worst.depth_error_p99_mm / summary.diagonal_mm;
  const std::string name = fitted_text(worst.name, std::min<std::size_t>(characters(worst.name).size(), 40));
  out += wrapped_text(fmt::format("worst depth error: {} mm at p99 in {} ({:.2f} % of the object's diagonal)",
                                  mm_text(worst.depth_error_p99_mm), name, diagonal_pct),
                      "", "  ");
  out += fmt::format("the surface is felt within {} mm at p50, {} mm at p99; {:.2f} % of it is not felt\n",
                     mm_text(summary.felt_p50_mm), mm_text(summary.felt_p99_mm), 100 * summary.not_felt_share);
  for (const std::string& note : summary.notes)
    out += wrapped_text(note, "! ", "  ");
  return out;
}

std::string wrapped_text(std::string_view text, std::string_view first, std::string_view rest) {
  std::string out(first);
  std::size_t column = first.size();
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = printable(text.substr(at, end - at));
    const std::size_t length = characters(word).size();
    if (column + length > kTableColumns && column > rest.size()) {
      out.back() = '\n';
      out += rest;
      column = rest.size();
    }
    out += word + ' ';
    column += length + 1;
    at = end + 1;
  }
  if (out.empty()) return "\n";
  out.back() = '\n';
  return out;
}

std::string printable(std::string_view text) {
  std::string out;
  for (const std::string& character : characters(text))
    out += character;
  return out;
}

std::string fitted_text(std::string_view text, std::size_t columns) {
  const std::vector<std::string> all = characters(text);
  std::string out;
  if (all.size() <= columns) return printable(text) + std::string(columns - all.size(), ' ');
  if (columns == 0) return out;
  const std::size_t front = (columns - 1) / 2;
  for (std::size_t i = 0; i < front; ++i)
    out += all[i];
  out += "…";
  for (std::size_t i = all.size() - (columns - 1 - front); i < all.size(); ++i)
    out += all[i];
  return out;
}

}  // namespace mechane::fit
