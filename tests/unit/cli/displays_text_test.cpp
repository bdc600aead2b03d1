#include "client-sdk/cli/displays_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/error_like.hpp"

namespace mechane::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A display that is well.
client::DisplayStatus well() {
  client::DisplayStatus display;
  display.kiosk = "kiosk-1";
  display.display = "wall";
  display.session = 1;
  display.host = "αίθουσα-2";
  display.uptime_s = 3600;
  display.width = 1920;
  display.height = 1080;
  display.pictures_per_s = 59.9;
  display.link = 1;
  display.scenario = "odometer";
  display.showing = "world";
  display.renderer = "NVIDIA GeForce";
  display.sound = "HDMI";
  display.settings = client::settings_of({});
  return display;
}

TEST(DisplaysText, of_a_display_that_is_well_nothing_is_remarked) {
  EXPECT_THAT(remarks_of(well()), IsEmpty());
}

TEST(DisplaysText, each_fault_has_its_remark_and_says_what_to_do) {
  const auto remark = [](auto spoil) {
    client::DisplayStatus display = well();
    spoil(display);
    const auto remarks = remarks_of(display);
    return remarks.size() == 1 ? remarks[0] : std::to_string(remarks.size()) + " remarks";
  };
  EXPECT_THAT(remark([](auto& d) { d.link = 0; }), HasSubstr("looking for a server"));
  EXPECT_THAT(remark([](auto& d) { d.link = 3; }), HasSubstr("fallen silent"));
  EXPECT_THAT(remark([](auto& d) {
                d.link = 2;
                d.refusal = "six worlds run already";
              }),
              HasSubstr("six worlds run already"));
  EXPECT_THAT(remark([](auto& d) { d.width = d.height = 0; }), HasSubstr("minimised"));
  EXPECT_THAT(remark([](auto& d) { d.renderer = "llvmpipe (LLVM 15.0.6, 256 bits)"; }), HasSubstr("driver"));
  EXPECT_THAT(remark([](auto& d) { d.pictures_per_s = 11; }), HasSubstr("smaller --size"));
  EXPECT_THAT(remark([](auto& d) { d.frames_lost = 0.1; }), HasSubstr("10.0 % of the scene's frames"));
  EXPECT_THAT(remark([](auto& d) {
                d.missing_total = 9;
                d.missing = {"a.glb", "b.glb"};
              }),
              HasSubstr("9 files are missing, plain boxes stand in their place: a.glb, b.glb, ..."));
  EXPECT_THAT(remark([](auto& d) {
                d.missing_total = 1;
                d.missing = {"a.glb"};
              }),
              "1 file is missing, a plain box stands in its place: a.glb; start it in the server's folder, or give "
              "--assets or --catalogue");
  EXPECT_THAT(remark([](auto& d) {
                d.sound.clear();
                d.sound_problem = "there is no sound device";
              }),
              HasSubstr("there is no sound device"));
  EXPECT_THAT(remark([](auto& d) {
                d.warnings = 3;
                d.last_warning = "a.glb: no such file";
              }),
              "warning 3 of 3: a.glb: no such file");
}

TEST(DisplaysText, silence_that_was_requested_for_is_no_fault) {
  client::DisplayStatus display = well();
  display.sound.clear();
  display.sound_problem = "muted";
  client::DisplaySettings settings;
  settings.muted = true;
  display.settings = client::settings_of(settings);
  EXPECT_THAT(remarks_of(display), IsEmpty());
}

TEST(DisplaysText, two_of_one_name_are_told_apart) {
  client::DisplayStatus twin = well();
  twin.session = 2;
  twin.process_id = 42;
  const std::string table = displays_table({well(), twin});
  EXPECT_THAT(table, HasSubstr("another display has the same name (this one is process 42"));
  twin.display = "bystanders";
  EXPECT_THAT(displays_table({well(), twin}), Not(HasSubstr("same name")));
}

TEST(DisplaysText, columns_stand_under_each_other_with_letters_of_any_size) {
  client::DisplayStatus far = well();
  far.kiosk = "a-kiosk-with-a-long-name";
  const std::string table = displays_table({well(), far});
  std::vector<std::size_t> places;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
    places.push_back(line.find(line.starts_with("display") ? "host" : "αίθουσα"));
  EXPECT_THAT(places, ElementsAre(places[0], places[0], places[0]));
}

TEST(DisplaysText, a_line_of_json_a_display) {
  client::DisplayStatus display = well();
  display.last_warning = "caf\xe9";  // not UTF-8: from another program's log
  const auto json = nlohmann::json::parse(displays_json({display}));
  EXPECT_EQ(json["settings"]["volume"], "0.8");
  EXPECT_EQ(json["link"], "joined");
  EXPECT_EQ(json["remarks"].size(), 1U);
}

TEST(DisplaysText, numbers_of_the_wire_are_rounded_to_what_they_mean) {
  client::DisplayStatus display = well();
  display.frames_lost = static_cast<double>(0.8F);  // as they come
  display.picture_ms_p99 = static_cast<double>(16.7F);
  const std::string json = displays_json({display});
  EXPECT_THAT(json, HasSubstr("\"frames_lost\":0.8,"));
  EXPECT_THAT(json, HasSubstr("\"p99\":16.7}"));
}

TEST(DisplaysText, who_names_no_display_hears_which_there_are) {
  EXPECT_THAT(no_display({}, "kiosk-2", ""), test::is_error(ErrorCode::not_found, 0));
  EXPECT_THAT(no_display({well(), well()}, "kiosk-2", ""),
              test::is_error(ErrorCode::unknown_name, 0, {"kiosk-2/*", "kiosk-1/wall"}));
}

}  // namespace
}  // namespace mechane::cli
