// A draft loses nothing that was answered: every revision comes back to the byte, and what a kill or a full disk leaves is told.
#include "client-sdk/studio/draft/draft.hpp"

#include <csignal>
#include <fstream>
#include <random>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "client-sdk/studio/edits/apply.hpp"
#include "server/base/utf8.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_files.hpp"
#include "tests/unit/studio/studio_fixture.hpp"

namespace mechane::studio {
namespace {

using test::ScratchFolder;
using test::shipped_file;
using test::text_of;

const Author kAuthor{"eleni", 1'700'000'000};

Draft made(const ScratchFolder& folder, const std::string& text) {
  auto draft = Draft::make(folder.path() / "d", text, "exhibit:screw", kAuthor);
  EXPECT_TRUE(draft) << draft.error().to_string();
  return std::move(*draft);
}

Draft reopened(const ScratchFolder& folder) {
  auto draft = Draft::open(folder.path() / "d");
  EXPECT_TRUE(draft) << draft.error().to_string();
  return std::move(*draft);
}

std::string file_text(const std::filesystem::path& file) {
  return text_of(file);
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// Valid and invalid edits, many of them of the same places.
class RandomCommands {
 public:
  Command next() {
    const std::string number = std::to_string(draw(4));
    switch (draw(11)) {
      case 0:
        return SetValue{"effortScale", std::vector<double>{0.01 * static_cast<double>(1 + draw(50))}};
      case 1:
        return SetValue{"text/title.el", std::vector<std::string>{"Ο κοχλίας ‘" + number + "’ & <ξύλο>"}};
      case 2:
        return AddSet{"quantities/new-" + number, ""};
      case 3:
        return RemoveEntry{"quantities/new-" + number};
      case 4:
        return SetField{"INNER", "mass", std::to_string(draw(90)) + (draw(3) == 0 ? " kg" : "")};
      case 5:
        return RenameEverywhere{NameKind::thing, draw(2) == 0 ? "INNER" : "RENAMED",
                                draw(2) == 0 ? "INNER" : "RENAMED"};
      case 6:
        return InsertPart{draw(5) == 0 ? "no-such" : "box", "", Vec3(0.1 * static_cast<double>(draw(9)), 1, 0)};
      case 7:
        return DuplicateBody{draw(2) == 0 ? "BOX" : "INNER", std::nullopt};
      case 8:
        return JoinBodies{draw(2) == 0 ? state::JointKind::ball : state::JointKind::slider,
                          draw(2) == 0 ? "BOX" : "OUTER",
                          draw(2) == 0 ? "INNER" : "",
                          Vec3::Zero(),
                          Vec3::UnitY(),
                          ""};
      case 9:
        return AddView{draw(4) == 0 ? "no name" : "NEAR", Pose{Vec3(1, 2, 3), Quat::Identity()}, 0.7, "‘near’ & <low>"};
      default:
        return DeleteNode{draw(2) == 0 ? "BOX" : "BOX_2"};
    }
  }
  std::size_t draw(std::size_t below) { return std::uniform_int_distribution<std::size_t>(0, below - 1)(random_); }

 private:
  std::mt19937 random_{20261128};  // NOLINT: the same in each run
};

TEST(Draft, AHundredEditsAreUndoneAndDoneAgainToTheByte) {
  const ScratchFolder folder;
  Draft draft = made(folder, text_of(shipped_file()));
  RandomCommands random;
  std::vector<std::string> texts{draft.text()};
  int refused = 0;
  while (texts.size() <= 100) {
    const Command command = random.next();
    const auto applied = apply_commands(draft.text(), shipped_file(), {&command, 1});
    if (!applied) {
      ++refused;
      EXPECT_FALSE(applied.error().error.remedy.empty()) << applied.error().error.to_string();
      continue;
    }
    if (applied->text == draft.text()) continue;
    ASSERT_TRUE(draft.step(title_of(command), applied->text, kAuthor));
    texts.push_back(draft.text());
  }
  EXPECT_GT(refused, 5) << "some of them are wrong";
  EXPECT_EQ(draft.revision(), 100);
  draft = reopened(folder);  // as after a kill
  EXPECT_EQ(draft.notice(), "");
  for (std::size_t i = texts.size() - 1; i-- > 0;) {
    ASSERT_TRUE(draft.undo(kAuthor));
    ASSERT_EQ(draft.text(), texts[i]) << "revision " << i;
    if (i == 40) draft = reopened(folder);
  }
  EXPECT_THAT(draft.undo(kAuthor).error(), is_fault(ErrorCode::conflict));
  EXPECT_EQ(file_text(draft.file()), text_of(shipped_file()));
  for (std::size_t i = 1; i < texts.size(); ++i) {
    ASSERT_TRUE(draft.redo(kAuthor));
    ASSERT_EQ(draft.text(), texts[i]) << "revision " << i;
    if (i == 60) draft = reopened(folder);
  }
  EXPECT_FALSE(draft.redo(kAuthor));
  EXPECT_EQ(draft.revision(), 300);
  EXPECT_EQ(file_text(draft.file()), texts.back());
}

TEST(Draft, KilledBetweenTheStepAndTheTextItIsCompleted) {
  const ScratchFolder folder;
  Draft draft = made(folder, "one two");
  ASSERT_TRUE(draft.step("first", "one three", kAuthor));
  const std::string between = draft.text();
  ASSERT_TRUE(draft.step("second", "one three four", kAuthor));
  write_text(draft.file(), between);  // the step was written, the text not yet
  draft = reopened(folder);
  EXPECT_EQ(draft.text(), "one three four");
  EXPECT_EQ(file_text(draft.file()), "one three four");
  EXPECT_EQ(draft.revision(), 2);
  EXPECT_EQ(draft.notice(), "");
  ASSERT_TRUE(draft.undo(kAuthor));
  EXPECT_EQ(draft.text(), between);
}

TEST(Draft, AHistoryThatIsCutAnywhereKeepsTheText) {
  const ScratchFolder folder;
  Draft draft = made(folder, "ένα");
  ASSERT_TRUE(draft.step("first", "ένα δύο", kAuthor));
  ASSERT_TRUE(draft.step("second", "ένα δύο τρία", kAuthor));
  const auto file = folder.path() / "d/history.jsonl";
  const std::string whole = file_text(file);
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    write_text(file, whole.substr(0, size));
    Draft again = reopened(folder);
    EXPECT_EQ(again.text(), "ένα δύο τρία") << size;
    EXPECT_NE(again.notice(), "") << size;
    ASSERT_TRUE(again.step("third", "τέλος", kAuthor)) << size;
    Draft third = reopened(folder);
    EXPECT_EQ(third.text(), "τέλος");
    EXPECT_EQ(third.notice(), "") << "it goes on as ever";
    ASSERT_TRUE(third.undo(kAuthor));
    EXPECT_EQ(third.text(), "ένα δύο τρία");
  }
}

TEST(Draft, ADamagedHistoryIsToldAndSetAside) {
  const ScratchFolder folder;
  Draft draft = made(folder, "ένα");
  ASSERT_TRUE(draft.step("first", "ένα δύο", kAuthor));
  const auto file = folder.path() / "d/history.jsonl";
  const std::string whole = file_text(file);
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"\"revision\":1", "\"revision\":7"}, {"\"do\":\"step\"", "\"do\":\"stop\""}, {"δύο", "τρία"}, {"{", "["}}) {
    std::string bad = whole;
    bad.replace(bad.find(from), from.size(), to);
    write_text(file, bad);
    const bool told = from != "δύο";  // the text is the right one, but what is undone is not: seen when it is undone
    Draft again = reopened(folder);
    EXPECT_EQ(again.text(), "ένα δύο") << from;
    EXPECT_EQ(!again.notice().empty(), told) << from;
    EXPECT_EQ(again.history().undoable().empty(), told) << from;
    if (told) {
      EXPECT_NE(again.notice().find("history.damaged-"), std::string::npos);
    } else {
      EXPECT_THAT(again.undo(kAuthor).error(), is_fault(ErrorCode::damaged));
    }
    EXPECT_EQ(again.text(), "ένα δύο") << from;
  }
}

TEST(Draft, AFullDiskKeepsTheFormerDraft) {
  const ScratchFolder folder;
  Draft draft = made(folder, "one");
  ASSERT_TRUE(draft.step("first", "two", kAuthor));
  const auto with_room = [&](rlim_t bytes, const std::string& text) {
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{bytes, before.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    const auto done = draft.step("large", text, kAuthor);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    return done;
  };
  const std::string large(20'000, 'x');
  // Once the step has no room, and once the step has, and the text has not.
  const auto step = with_room(10'000, large);
  ASSERT_FALSE(step);
  EXPECT_THAT(step.error(), is_fault(ErrorCode::io_failure, {"history.jsonl"}));
  ASSERT_TRUE(draft.step("grow", std::string(15'000, 'y'), kAuthor));
  ASSERT_TRUE(draft.undo(kAuthor));
  const auto text = with_room(12'000, std::string(15'000, 'y'));
  ASSERT_FALSE(text);
  EXPECT_THAT(text.error(), is_fault(ErrorCode::io_failure));
  EXPECT_FALSE(text.error().remedy.empty());
  EXPECT_EQ(draft.text(), "two");
  EXPECT_EQ(file_text(draft.file()), "two");
  ASSERT_TRUE(draft.step("after", "three", kAuthor)) << "with room again it goes on";
  Draft again = reopened(folder);
  EXPECT_EQ(again.text(), "three");
  EXPECT_EQ(again.notice(), "");
  ASSERT_TRUE(again.undo(kAuthor));
  EXPECT_EQ(again.text(), "two");
}

TEST(TextDelta, CutsNoLetterAndLeadsBothWays) {
  const std::vector<std::string> texts{"",    "a",     "αβγ",   "αέγ",    "aαa",   "aaaa",
                                       "aaa", "ααα β", "β ααα", "\u00e9", "\u00e8"};
  for (const std::string& from : texts) {
    for (const std::string& to : texts) {
      const TextDelta delta = delta_between(from, to);
      EXPECT_EQ(applied(from, delta), to) << from << " -> " << to;
      EXPECT_EQ(applied(to, delta.reversed()), from);
      EXPECT_FALSE(first_bad_utf8(delta.before) || first_bad_utf8(delta.after)) << from << " -> " << to;
    }
  }
  EXPECT_FALSE(applied("abc", {1, "x", "y"}));
  EXPECT_FALSE(applied("abc", {9, "", "y"}));
}

}  // namespace
}  // namespace mechane::studio
