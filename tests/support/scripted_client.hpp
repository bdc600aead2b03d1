// A joined client whose server's answers are put in by a test.
#pragma once

#include <algorithm>
#include <utility>

#include <mechane/client/client.hpp>

namespace mechane::test {

class ScriptedClient final : public client::Client {
 public:
  std::optional<client::ForceSample> arrived;
  client::HandSample hand;  ///< the last that was sent
  std::vector<client::DeviceRequest> requests;
  client::DeviceDetails details;  ///< the last that were told

  /// What a server answers at `now` that renders a floor at y = 0.
  void answer_with_floor(double stiffness_n_per_m, TimePoint now) {
    client::ForceSample& answer = next_answer(now);
    constexpr double kNear_m = 0.02;  // as a server sees it
    const double depth_m = -hand.X_WH.p.y();
    answer.force_W.f.y() = stiffness_n_per_m * std::max(0.0, depth_m);
    answer.contact_count = depth_m > -kNear_m ? 1 : 0;
    answer.contacts[0] = {.n_W = Vec3::UnitY(), .depth_m = depth_m, .stiffness_n_per_m = stiffness_n_per_m};
  }
  /// What a server computed of the last sample that was sent.
  client::ForceSample& answer_with(const hand::HapticOutput& output, TimePoint now) {
    client::ForceSample& answer = next_answer(now);
    static_cast<hand::HapticOutput&>(answer) = output;
    answer.echo_sequence = sent_;
    return answer;
  }
  /// An answer to the last sample that was sent; to be filled in.
  client::ForceSample& next_answer(TimePoint now) {
    client::ForceSample& answer = arrived.emplace();
    answer.sequence = ++answers_;
    answer.echo_sequence = sent_;
    answer.received = now;
    return answer;
  }

  [[nodiscard]] client::LinkState state() const override { return client::LinkState::joined; }
  [[nodiscard]] bool wait_for(client::LinkState wanted, Duration) override { return wanted == state(); }
  [[nodiscard]] std::string refusal() const override { return {}; }
  [[nodiscard]] std::uint64_t session() const override { return 1; }
  bool send(const client::HandSample& sample) noexcept override {
    hand = sample;
    return ++sent_ > 0;
  }
  bool tell_details(const client::DeviceDetails& told) override {
    details = told;
    return true;
  }
  [[nodiscard]] std::vector<client::DeviceRequest> take_device_requests() override {
    return std::exchange(requests, {});
  }
  [[nodiscard]] std::uint64_t sent_sequence() const noexcept override { return sent_; }
  [[nodiscard]] std::optional<client::ForceSample> newest_force() noexcept override {
    return std::exchange(arrived, std::nullopt);
  }
  [[nodiscard]] std::optional<client::ForceSample> wait_force(Duration) override { return newest_force(); }
  [[nodiscard]] bool newest_frame(client::Frame&) override { return false; }
  [[nodiscard]] bool interpolated_frame(TimePoint, Duration, client::Frame&) override { return false; }
  [[nodiscard]] std::vector<client::SceneObject> objects() const override { return {}; }
  [[nodiscard]] std::optional<client::WorldStatus> world_status() const override { return {}; }
  [[nodiscard]] std::shared_ptr<const client::WorldPresentation> presentation() const override { return {}; }
  [[nodiscard]] std::optional<client::ServerStatus> server_status() const override { return {}; }
  [[nodiscard]] std::vector<client::WorldEvent> take_events() override { return {}; }
  std::uint64_t start_activity(const std::string&) override { return 0; }
  std::uint64_t restart_activity() override { return 0; }
  std::uint64_t next_step() override { return 0; }
  std::uint64_t click(const std::string&) override { return 0; }
  std::uint64_t open_exhibit(const std::string&) override { return 0; }
  std::uint64_t answer(const client::VisitAnswer&) override { return 0; }
  std::uint64_t tell_language(const std::string&) override { return 0; }

 private:
  std::uint64_t sent_ = 0;
  std::uint64_t answers_ = 0;
};

}  // namespace mechane::test
