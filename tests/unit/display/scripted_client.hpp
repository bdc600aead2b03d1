// A client whose server is the test: what it knows is put in, and what it was asked to send is kept.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/recording/recording_samples.hpp"
#include <mechane/client/client.hpp>

namespace mechane::display {

class ScriptedClient final : public client::Client {
 public:
  client::LinkState link = client::LinkState::joined;
  std::string why_refused;
  std::optional<client::WorldStatus> status;
  std::shared_ptr<const client::WorldPresentation> presented;
  std::vector<client::SceneObject> manifest;
  std::optional<client::Frame> newest;   ///< as it came
  std::optional<client::Frame> between;  ///< as it is to be shown
  std::optional<client::ServerStatus> server;
  std::optional<client::ViewerHead> head;
  std::vector<client::DeviceReport> at_hand;  ///< haptic devices
  std::vector<client::WorldEvent> events;
  bool sends = true;              ///< false: every command is lost
  std::vector<std::string> sent;  ///< commands, oldest first: "click BUCKET"
  std::vector<std::pair<TimePoint, Duration>> frames_asked;

  /// All of a world but its frames.
  void enter(const std::string& world) {
    status = recording::status_of_visit(world, "turn");
    presented = std::make_shared<client::WorldPresentation>(recording::presentation_of_visit(world));
    manifest = recording::manifest_of_visit();
    newest.reset();
    between.reset();
  }

  [[nodiscard]] client::LinkState state() const override { return link; }
  [[nodiscard]] bool wait_for(client::LinkState wanted, Duration) override { return wanted == link; }
  [[nodiscard]] std::string refusal() const override { return why_refused; }
  [[nodiscard]] std::uint64_t session() const override { return 1; }
  bool send(const client::HandSample&) noexcept override { return false; }
  [[nodiscard]] std::uint64_t sent_sequence() const noexcept override { return 0; }
  [[nodiscard]] std::optional<client::ForceSample> newest_force() noexcept override { return {}; }
  [[nodiscard]] std::optional<client::ForceSample> wait_force(Duration) override { return {}; }
  [[nodiscard]] bool newest_frame(client::Frame& out) override {
    if (newest) out = *newest;
    return newest.has_value();
  }
  [[nodiscard]] bool interpolated_frame(TimePoint at, Duration delay, client::Frame& out) override {
    frames_asked.emplace_back(at, delay);
    if (between) out = *between;
    return between.has_value();
  }
  [[nodiscard]] std::vector<client::SceneObject> objects() const override { return manifest; }
  [[nodiscard]] std::optional<client::WorldStatus> world_status() const override { return status; }
  [[nodiscard]] std::shared_ptr<const client::WorldPresentation> presentation() const override { return presented; }
  [[nodiscard]] std::optional<client::ServerStatus> server_status() const override { return server; }
  [[nodiscard]] std::vector<client::WorldEvent> take_events() override { return std::exchange(events, {}); }
  [[nodiscard]] std::optional<client::ViewerHead> viewer_head() override { return head; }
  [[nodiscard]] std::vector<client::DeviceReport> devices() override { return at_hand; }
  std::uint64_t start_activity(const std::string& activity) override { return command("start " + activity); }
  std::uint64_t restart_activity() override { return command("restart"); }
  std::uint64_t next_step() override { return command("next"); }
  std::uint64_t click(const std::string& object) override { return command("click " + object); }
  std::uint64_t open_exhibit(const std::string& scenario) override { return command("open " + scenario); }
  std::uint64_t answer(const client::VisitAnswer& given) override {
    return command("answer " + given.question + " " + given.answer);
  }
  std::uint64_t tell_language(const std::string& language) override { return command("language " + language); }

 private:
  std::uint64_t command(std::string what) {
    if (!sends) return 0;
    sent.push_back(std::move(what));
    return sent.size();
  }
};

}  // namespace mechane::display
