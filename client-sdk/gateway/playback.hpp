// Visits played back: a child process shows a recorded visit as a world in a DDS domain of its own, and what a display hears of it becomes
// a tape, which a page plays by itself: forwards, backwards, at any speed. STREAM.md has the tape's form.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "client-sdk/gateway/browsers/backstage.hpp"
#include "client-sdk/gateway/gateway.hpp"
#include "client-sdk/gateway/http/frame_bytes.hpp"
#include "server/content/child_process.hpp"
#include "server/visits/visit_record.hpp"
#include <mechane/client/client.hpp>

namespace mechane::gateway {

/// The tape as a browser gets it. Pure: without a network or a clock.
class TapeWriter {
 public:
  static constexpr std::size_t kMostBytes = std::size_t{64} << 20U;

  void add_text(const std::string& text) { add(1, text); }
  void add_frame(const FrameBody& frame);
  /// False: no room is left, and what came since is missing.
  [[nodiscard]] bool goes_on() const { return !full_; }
  [[nodiscard]] std::size_t frames() const { return frames_; }
  /// Between the first frame and the newest one, in ticks.
  [[nodiscard]] std::uint64_t ticks() const { return newest_ - first_; }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  void add(std::uint32_t kind, std::string_view payload);

  std::string bytes_;
  std::uint64_t first_ = 0, newest_ = 0;
  std::size_t frames_ = 0;
  bool full_ = false;
};

/// One visit on its way to a tape. On the loop's thread; the child's end is waited for on a thread of its own.
class Playback : public std::enable_shared_from_this<Playback> {
 public:
  enum class State : std::uint8_t { preparing, ready, failed };

  Playback(const visits::VisitRecord& visit, const GatewayOptions& options, std::uint32_t domain,
           const Backstage& backstage);
  ~Playback();
  Playback(const Playback&) = delete;
  Playback& operator=(const Playback&) = delete;

  /// Starts the child and the client.
  void open();
  /// Call it two hundred times a second.
  void tick();

  [[nodiscard]] const visits::VisitRecord& visit() const { return visit_; }
  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] std::uint32_t domain() const { return domain_; }
  /// How much of the visit is on the tape, 0 to 1.
  [[nodiscard]] double share() const;
  /// Why it failed, for people.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  /// Null until it is ready.
  [[nodiscard]] const std::shared_ptr<const std::string>& tape() const { return tape_; }

 private:
  void take_texts();
  void take_frame();
  void end(const Expected<content::ChildResult>& child);

  const visits::VisitRecord visit_;
  const std::string kiosk_;  ///< of the world that the child shows
  const std::uint32_t domain_;
  const std::filesystem::path scenario_;
  const Backstage backstage_;
  const std::vector<std::string> arguments_;
  State state_ = State::preparing;
  std::string trouble_;
  std::shared_ptr<const std::string> tape_;
  TapeWriter writer_;
  std::unique_ptr<client::Client> client_;
  std::map<std::string, std::string> told_;  ///< the newest text of each kind
  client::Frame frame_;
  std::uint64_t sequence_ = 0;
  std::stop_source stop_;
  std::unique_ptr<Worker> thread_;
};

/// The playbacks of a gateway. On the loop's thread.
class PlaybackShelf {
 public:
  static constexpr std::size_t kMostAtOnce = 2;  ///< children
  static constexpr std::size_t kMostKept = 3;

  /// The visit's playback; it is begun if nobody has begun it yet. Null: too many are being prepared.
  [[nodiscard]] std::shared_ptr<Playback> begin(const visits::VisitRecord& visit, const GatewayOptions& options,
                                                const Backstage& backstage, TimePoint now);
  /// The visit's playback; null: nobody has begun it. A playback that nobody asks for ends soon, and its child with it.
  [[nodiscard]] std::shared_ptr<Playback> find(const std::string& number, TimePoint now);
  void tick(TimePoint now);

 private:
  struct Kept {
    std::shared_ptr<Playback> playback;
    TimePoint used;
  };
  std::map<std::string, Kept> kept_;
};

}  // namespace mechane::gateway
