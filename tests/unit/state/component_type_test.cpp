// Parameters of a component, checked against its type: each fault has a code, the line of its parameter, and a remedy.
#include "server/state/component_type.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/error_like.hpp"

namespace mechane::state {
namespace {

using test::is_error;

constexpr ParameterType kParameters[] = {
    {.name = "body", .kind = ParameterKind::text, .required = true, .reference = Reference::body},
    {.name = "speed", .unit = "m/s", .min = 0, .max = 10},
    {.name = "size", .kind = ParameterKind::numbers, .unit = "m", .count = 3},
    {.name = "reverse", .kind = ParameterKind::boolean},
};
constexpr ComponentType kMover{"test.mover", "Moves a body", kParameters, {}};
constexpr ComponentType kBare{"test.bare", "Takes no parameters", {}, {}};

WorldDescription one_body() {
  WorldDescription world;
  world.bodies.emplace_back().name = "WHEEL";
  return world;
}

/// In line 10, with its parameters in the lines that follow, by the alphabet.
ComponentDescription mover(std::map<std::string, Parameter> parameters) {
  ComponentDescription component{"MOVER", "test.mover", std::move(parameters), 10};
  int line = 11;
  for (const auto& [name, value] : component.parameters)
    component.parameter_lines[name] = line++;
  return component;
}

Error error_of(const ComponentType& type, const ComponentDescription& component, const WorldDescription& world) {
  const auto checked = Parameters::check(type, component, world);
  return checked ? Error{} : checked.error();
}

const Parameter kWheel = std::vector<std::string>{"WHEEL"};

TEST(ComponentType, FaultsHaveTheLineOfTheirParameter) {
  const WorldDescription world = one_body();
  const auto fault = [&](const std::string& name, const Parameter& value) {
    std::map<std::string, Parameter> parameters{{"body", kWheel}};
    parameters[name] = value;
    return error_of(kMover, mover(std::move(parameters)), world);
  };
  EXPECT_THAT(fault("sped", std::vector<double>{1}),
              is_error(ErrorCode::unknown_name, 12, {"'sped'", "body, speed, size, reverse"}));
  EXPECT_THAT(fault("speed", std::vector<double>{11}),
              is_error(ErrorCode::invalid_value, 12, {"line 12, test.mover MOVER", "11"}));
  EXPECT_THAT(fault("speed", true), is_error(ErrorCode::invalid_value, 12, {"speed", "one number"}));
  EXPECT_THAT(fault("size", std::vector<double>{1, 2}), is_error(ErrorCode::invalid_value, 12, {"size has 2", "3"}));
  EXPECT_THAT(fault("reverse", std::vector<double>{1}),
              is_error(ErrorCode::invalid_value, 12, {"reverse", "true or false"}));
  EXPECT_THAT(fault("body", std::vector<std::string>{"WHEL"}),
              is_error(ErrorCode::unknown_name, 11, {"body", "'WHEL'", "WHEEL"}));
  EXPECT_THAT(fault("body", std::vector<std::string>{"WHEEL", "WHEEL"}), is_error(ErrorCode::invalid_value, 11, {"2"}));
}

TEST(ComponentType, AMissingParameterHasTheLineOfItsComponent) {
  EXPECT_THAT(error_of(kMover, mover({}), one_body()),
              is_error(ErrorCode::missing, 10, {"line 10, test.mover MOVER", "'body'"}));
}

TEST(ComponentType, ARemedyNamesSomethingEvenWhereThereIsNothingToName) {
  const Error bare = error_of(kBare, mover({{"speed", std::vector<double>{1}}}), one_body());
  EXPECT_THAT(bare, is_error(ErrorCode::unknown_name, 11, {"'speed'"}));
  EXPECT_EQ(bare.remedy, "remove it");
  const Error empty = error_of(kMover, mover({{"body", kWheel}}), WorldDescription());
  EXPECT_THAT(empty, is_error(ErrorCode::unknown_name, 11, {"'WHEEL'", "has no body"}));
}

TEST(ComponentType, APlaceIsThatOfTheParameterOrElseOfTheComponent) {
  const ComponentDescription component = mover({{"body", kWheel}});
  const Place body = parameter_place(component, "body");
  EXPECT_EQ(body.line, 11);
  EXPECT_EQ(body.text, "line 11, test.mover MOVER");
  EXPECT_EQ(parameter_place(component, "speed").line, 10);
  EXPECT_EQ(parameter_place(component, {}).text, "line 10, test.mover MOVER");
}

}  // namespace
}  // namespace mechane::state
