// Displays refuse a world with more than 256 of a kind; so does the checker, before the museum opens.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "server/state/limits.hpp"
#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

/// As many lines as `count`, each with "{}" replaced by its number.
std::string lines_of(std::size_t count, const std::string& line) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i)
    text += fmt::format(fmt::runtime(line), i) + "\n";
  return text;
}

TEST(CheckPresented, TooManyViewpointsAreRefusedAtTheFirstOne) {
  const std::size_t has = compile_text(text_of(shipped_file())).world->viewpoints.size();
  const auto with = [&](std::size_t more) {
    return edited("<Viewpoint ", lines_of(more, "<Viewpoint DEF='MORE{}' position='0 0 1'/>") + "<Viewpoint ");
  };
  EXPECT_TRUE(compile_text(with(state::kMaxPresented - has)).world);
  const std::string text = with(state::kMaxPresented + 1);
  const x3d::Problem problem =
      compile_text(text).find(ErrorCode::too_large, line_of(text, "DEF='MORE256'"), "displays take 256");
  EXPECT_EQ(problem.severity, x3d::Severity::error);
}

TEST(CheckPresented, TooManyAnswersAreRefusedAtTheirQuestion) {
  const std::string key = "name='answers' value='";
  const std::string text = edited(key, key + lines_of(state::kMaxPresented, "\"a{}\"") + " ");
  const x3d::Problem problem = compile_text(text).find(ErrorCode::too_large, kAnyLine, "answers are too many");
  EXPECT_EQ(problem.severity, x3d::Severity::error);
}

TEST(CheckPresented, ARopeThatIsNotSeenIsNamed) {
  const std::string agents = "name='agents'>";
  const std::string text = edited(
      agents,
      agents +
          lines_of(
              state::kMaxShownRopes + 1,
              "<MetadataSet containerField='value' name='ROPE{}'><MetadataString containerField='value' name='type' "
              "value='\"geometry.rope\"'/></MetadataSet>"));
  const x3d::Problem problem = compile_text(text).find(ErrorCode::too_large, line_of(text, "'ROPE8'"), "draw 8 ropes");
  EXPECT_EQ(problem.severity, x3d::Severity::warning);
}

TEST(CheckPresented, MoreLanguagesThanDisplaysTakeAreRefused) {
  const std::string key = "name='languages' value='";
  const std::string text = edited(key, key + lines_of(state::kMaxLanguages, "\"l{}\"") + " ");
  static_cast<void>(compile_text(text).find(ErrorCode::too_large, kAnyLine, "displays take 64"));
}

}  // namespace
}  // namespace mechane::scenario
