// X3D's own events, from a file's text to ticks: without dynamics, and with a ball of 0.5 m for every shape.
#pragma once

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "server/agents/agent_set.hpp"
#include "server/base/clock.hpp"
#include "server/collision/samples.hpp"
#include "server/collision/superquadric_object.hpp"
#include "server/scenario/compiler.hpp"

namespace mechane::agents::test {

class Balls final : public scenario::ObjectLoader {
 public:
  Expected<std::shared_ptr<const collision::Object>> load(const std::filesystem::path& /*file*/,
                                                          const std::string& /*node*/,
                                                          const geometry::SolidChoice& /*solid*/) override {
    return ball_;
  }
  Expected<std::optional<scenario::Solid>> solid(const std::filesystem::path& /*file*/,
                                                 const std::string& /*node*/) override {
    return std::nullopt;
  }
  Expected<std::string> content_hash(const std::filesystem::path& /*file*/) override { return std::string(32, '0'); }

 private:
  static std::shared_ptr<const collision::Object> make_ball() {
    geometry::Superquadric ball;
    ball.a = Vec3(0.5, 0.5, 0.5);
    return std::make_shared<const collision::Object>(collision::make_superquadric_object(ball, 0.05));
  }

  std::shared_ptr<const collision::Object> ball_ = make_ball();
};

struct X3dStage {
  explicit X3dStage(const std::string& scene) : description(compiled(scene)), state(description) {
    auto made = AgentSet::create(description, layout);
    if (!made) throw std::runtime_error(made.error().to_string());
    agents = std::move(*made);
    state.memory = layout.initial();
    agents->start(state);
  }

  void tick() {
    ++state.tick;
    state.event_count = 0;
    agents->run(state, {}, kTickSeconds);
  }
  void run_to(double time_s) {
    while (state.tick < static_cast<std::uint64_t>(std::lround(time_s / kTickSeconds)))
      tick();
  }
  [[nodiscard]] double time_s() const { return static_cast<double>(state.tick) * kTickSeconds; }
  [[nodiscard]] double value(const std::string& name) const {
    const state::MemorySlot* slot = layout.find(name);
    if (slot == nullptr) throw std::runtime_error("nothing is called " + name);
    return state.memory[slot->index];
  }
  [[nodiscard]] const Pose& pose(const std::string& name) const {
    const BodyId body = description.find_body(name);
    if (!body) throw std::runtime_error("no body is called " + name);
    return state[body].X_WB;
  }
  void put_hand(const Vec3& p_WH) {
    state.users[0].present = true;
    state.users[0].X_WH.p = p_WH;
  }

  static state::WorldDescription compiled(const std::string& scene) {
    x3d::Problems problems("stage.x3d");
    static Balls balls;  // a property compiles hundreds of scenes
    const auto document = x3d::read_document("<X3D version='4.0' profile='Full'><Scene>\n" + scene + "</Scene></X3D>",
                                             "stage.x3d", problems);
    if (!document) throw std::runtime_error(document.error().to_string());
    auto world = scenario::compile(*document, balls, problems);
    if (!world) throw std::runtime_error(world.error().to_string());
    return std::move(*world);
  }

  const state::WorldDescription description;
  state::MemoryLayout layout;
  std::unique_ptr<AgentSet> agents;
  state::WorldState state;
};

inline std::string route(const std::string& from, const std::string& to) {
  const auto node = [](const std::string& end) { return end.substr(0, end.find('.')); };
  const auto field = [](const std::string& end) { return end.substr(end.find('.') + 1); };
  return "<ROUTE fromNode='" + node(from) + "' fromField='" + field(from) + "' toNode='" + node(to) + "' toField='" +
         field(to) + "'/>\n";
}

}  // namespace mechane::agents::test
