// RecordedClient: plays a recording as if it were a server. A display notices no difference, except that commands have
// no effect and there are no forces.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client-sdk/recording/frame_recording.hpp"
#include <mechane/client/client.hpp>

namespace mechane::recording {

struct PlaySettings {
  double speed = 1;    ///< above 0; 1: as recorded
  Duration from{0};    ///< where in the recording to begin
  bool again = false;  ///< start again at the end
};

/// One thread. Only advance() changes what is known, so that all of a picture is of the same moment.
class RecordedClient final : public client::Client {
 public:
  RecordedClient(FrameRecording recording, const PlaySettings& settings);

  /// Advances to `now` on the display's clock; the first call begins the recording. A time before the last one starts
  /// it again.
  void advance(TimePoint now);
  /// The next advance() starts again.
  void rewind() { began_.reset(); }
  /// Whether all has been shown. Never with PlaySettings::again.
  [[nodiscard]] bool over() const { return over_; }

  [[nodiscard]] client::LinkState state() const override { return client::LinkState::joined; }
  [[nodiscard]] bool wait_for(client::LinkState wanted, Duration timeout) override;
  [[nodiscard]] std::string refusal() const override { return {}; }
  [[nodiscard]] std::uint64_t session() const override { return 0; }
  bool send(const client::HandSample& input) noexcept override;
  [[nodiscard]] std::uint64_t sent_sequence() const noexcept override { return 0; }
  [[nodiscard]] std::optional<client::ForceSample> newest_force() noexcept override { return {}; }
  [[nodiscard]] std::optional<client::ForceSample> wait_force(Duration timeout) override;
  [[nodiscard]] bool newest_frame(client::Frame& out) override;
  /// Ignores `delay`: the next frame is already known.
  [[nodiscard]] bool interpolated_frame(TimePoint at, Duration delay, client::Frame& out) override;
  [[nodiscard]] std::vector<client::SceneObject> objects() const override { return manifest_; }
  [[nodiscard]] std::optional<client::WorldStatus> world_status() const override { return status_; }
  [[nodiscard]] std::shared_ptr<const client::WorldPresentation> presentation() const override { return presentation_; }
  [[nodiscard]] std::optional<client::ServerStatus> server_status() const override { return {}; }
  [[nodiscard]] std::vector<client::WorldEvent> take_events() override { return std::exchange(events_, {}); }
  std::uint64_t start_activity(const std::string& activity) override;
  std::uint64_t restart_activity() override { return 0; }
  std::uint64_t next_step() override { return 0; }
  std::uint64_t click(const std::string& object) override;
  std::uint64_t open_exhibit(const std::string& scenario) override;
  std::uint64_t answer(const client::VisitAnswer& /*answer*/) override { return 0; }
  std::uint64_t tell_language(const std::string& /*language*/) override { return 0; }

 private:
  void begin(TimePoint now);
  void take(const FrameRecording::Record& record);
  [[nodiscard]] const FrameRecording::Record* next_frame() const;

  FrameRecording recording_;
  PlaySettings settings_;
  std::optional<TimePoint> began_;
  Duration at_{0};        ///< of the recording
  std::size_t next_ = 0;  ///< the next record to be read
  bool over_ = false;
  std::optional<client::WorldStatus> status_;
  std::shared_ptr<const client::WorldPresentation> presentation_;
  std::vector<client::SceneObject> manifest_;
  std::optional<client::Frame> frame_;  ///< the last one that is known
  Duration frame_time_{0};
  std::vector<client::WorldEvent> events_;
};

}  // namespace mechane::recording
