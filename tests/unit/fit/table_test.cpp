#include "client-sdk/fit/table.hpp"

#include <sstream>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "client-sdk/fit/progress.hpp"
#include "client-sdk/fit/report_html.hpp"
#include "tests/unit/fit/fitted_things.hpp"

namespace mechane::fit {
namespace {

/// Characters of UTF-8 text.
std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

rc::Gen<double> millimetres() {
  return rc::gen::map(rc::gen::inRange(-3000, 4000), [](int exponent) { return std::pow(10, exponent / 1000.0); });
}

PartSummary any_part() {
  PartSummary part;
  part.name = *rc::gen::string<std::string>();
  part.triangles = *rc::gen::inRange<std::size_t>(1, 4'000'000);
  part.axes_mm = {*millimetres(), *millimetres(), *millimetres()};
  part.taper_x = *rc::gen::inRange(-9, 9) / 10.0;
  part.bend_deg = *rc::gen::inRange(0, 180);
  part.fit_mean_pct = *millimetres();
  part.fit_max_pct = *millimetres();
  part.map_kind = "distance brick";
  part.map_bytes = *rc::gen::inRange<std::size_t>(0, 4'000'000);
  part.depth_error_p50_mm = *millimetres();
  part.depth_error_p99_mm = *millimetres();
  part.samples = *rc::gen::inRange<std::size_t>(0, 1'000'000);
  return part;
}

RC_GTEST_PROP(Table, NoLineIsWiderThanTheTerminalAndNoNameReachesIt, ()) {
  Summary summary;
  for (int i = *rc::gen::inRange(1, 5); i > 0; --i)
    summary.parts.push_back(any_part());
  summary.diagonal_mm = *millimetres();
  summary.notes.push_back("part '" + *rc::gen::string<std::string>() + "' is not what it should be");
  const std::string table = summary_table(summary);
  RC_ASSERT(table.back() == '\n');
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    // A note's single word may be longer than a line.
    if (line.find(' ') != std::string::npos && line.rfind("! ", 0) != 0)
      RC_ASSERT(columns_of(line) <= kTableColumns || line[0] == ' ');
    RC_ASSERT(std::none_of(line.begin(), line.end(), [](char c) { return (c >= 0 && c < 0x20) || c == 0x7F; }));
  }
}

RC_GTEST_PROP(Table, FittedTextHasTheColumnsAskedFor, (const std::string& text)) {
  const auto columns = *rc::gen::inRange<std::size_t>(0, 60);
  RC_ASSERT(columns_of(fitted_text(text, columns)) == columns);
}

TEST(Table, AGreekNameKeepsItsEnds) {
  EXPECT_EQ(fitted_text("μέρος_λαβή_01", 9), "μέρο…ή_01");
  EXPECT_EQ(fitted_text("λαβή", 6), "λαβή  ");
  EXPECT_EQ(fitted_text("a\x1b[31mb", 7), "a?[31mb");
}

RC_GTEST_PROP(Progress, ABarStaysOnItsLine, ()) {
  const Stage stage{*rc::gen::string<std::string>(), "parts built", *rc::gen::inRange<std::size_t>(0, 400),
                    *rc::gen::inRange<std::size_t>(0, 300)};
  const auto columns = *rc::gen::inRange<std::size_t>(10, 200);
  RC_ASSERT(columns_of(bar_line(stage, 12, columns)) < columns);
}

TEST(Progress, LinesSayHowFarItIs) {
  EXPECT_EQ(plain_line({"screw.glb", "parts built", 12, 57}, 8.2),
            "screw.glb: parts built, 12 of 57, 8 s, about 31 s left");
  const std::string half = bar_line({"screw.glb", "parts built", 5, 10}, 3, 100);
  EXPECT_NE(half.find("████████████░░░░░░░░░░░░ 5/10 parts built, 3 s, about 3 s left"), std::string::npos) << half;
}

TEST(Report, AHostileNameIsTextAndThePageNeedsNothingFromOutside) {
  FittedObject crank = fitted_crank();
  crank.object.parts[1].name = "<script>alert('part')</script>";
  crank.mesh_file = "<img src=x onerror=1>.glb";
  const Surface surface(crank);
  const std::string page = html_page(make_report(crank, surface, summarise(crank, surface)));
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("<img src=x"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;"), std::string::npos);
  for (const char* outside : {"http:", "https:", "url(", "<link", "@import"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  std::size_t pictures = 0;
  for (std::size_t at = page.find("<img"); at != std::string::npos; at = page.find("<img", at + 1))
    ++pictures;
  EXPECT_EQ(pictures, 9U + 3U) << "three rows, and a map for each part";
  EXPECT_LT(page.size(), 3'000'000U);
}

}  // namespace
}  // namespace mechane::fit
