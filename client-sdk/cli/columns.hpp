// Tables of text for people: each column as wide as its widest cell.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/base/utf8.hpp"

namespace mechane::cli {

/// A table with a header. One thread.
class Columns {
 public:
  /// `sides` has a mark for each column, '<' to the left or '>' to the right; the last mark holds for all further ones.
  Columns(std::vector<std::string> head, std::string_view sides) : sides_(sides) { rows_.push_back(std::move(head)); }
  /// As many cells as the header has.
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  [[nodiscard]] bool is_empty() const { return rows_.size() == 1; }
  /// A line for each row, the header first. Widths are in letters, not bytes. Nothing is padded at a line's end.
  [[nodiscard]] std::string text(std::string_view indent = "") const {
    std::vector<std::size_t> widths(rows_.front().size());
    for (const auto& row : rows_) {
      for (std::size_t i = 0; i < row.size(); ++i)
        widths[i] = std::max(widths[i], utf8_letters(row[i]));
    }
    std::string out;
    for (const auto& row : rows_) {
      for (std::size_t i = 0; i < row.size(); ++i) {
        const std::string padding(widths[i] - utf8_letters(row[i]), ' ');
        out += i == 0 ? indent : "  ";
        if (sides_[std::min(i, sides_.size() - 1)] == '>')
          out += padding + row[i];
        else
          out += row[i] + (i + 1 < row.size() ? padding : "");
      }
      out += "\n";
    }
    return out;
  }

 private:
  std::string_view sides_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace mechane::cli
