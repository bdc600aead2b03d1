#include "client-sdk/cli/record.hpp"

#include <csignal>
#include <ostream>

#include <fmt/format.h>

#include "server/base/clock.hpp"
#include <mechane/client/client.hpp>

namespace mechane::cli {
namespace {

/// Twice for each frame that a server sends: the shortest step has some.
constexpr Duration kHearEvery = std::chrono::milliseconds(8);

volatile std::sig_atomic_t record_interrupted = 0;

/// Tells whom it hears, whenever that changes.
class Listener {
 public:
  Listener(client::Client& client, std::string kiosk, std::ostream& err)
      : client_(client), kiosk_(std::move(kiosk)), err_(err) {}

  /// Whether the kiosk is in a world.
  [[nodiscard]] bool joined() {
    const client::LinkState link = client_.state();
    if (link != told_ || link == client::LinkState::refused) tell(link);
    return link == client::LinkState::joined;
  }

 private:
  void tell(client::LinkState link) {
    std::string words = "looking for a server";
    if (link == client::LinkState::joined) words = "recording";
    if (link == client::LinkState::lost) words = "the server fell silent; recording goes on when it is back";
    if (link == client::LinkState::refused) words = client_.refusal();
    if (words != words_) err_ << "mechane record: " << kiosk_ << ": " << words << "\n" << std::flush;
    words_ = std::move(words);
    told_ = link;
  }

  client::Client& client_;
  std::string kiosk_;
  std::ostream& err_;
  std::optional<client::LinkState> told_;
  std::string words_;
};

void hear(client::Client& client, const RecordOptions& options, std::ostream& err, recording::FrameRecorder& recorder) {
  Listener listener(client, options.kiosk, err);
  SystemClock clock;
  const TimePoint began = clock.now();
  for (TimePoint now = began; record_interrupted == 0 && recorder.goes_on(); now = clock.now()) {
    if (options.seconds > 0 && to_seconds(now - began) >= options.seconds) return;
    if (listener.joined()) {
      recorder.hear(now, client);
      recorder.hear(now, client.take_events());
    }
    clock.sleep_until(now + kHearEvery);
  }
}

}  // namespace

int run_record(const RecordOptions& options, std::ostream& err) {
  std::signal(SIGINT, [](int) { record_interrupted = 1; });
  std::signal(SIGTERM, [](int) { record_interrupted = 1; });
  const auto fail_with = [&err](const std::string& what) {
    err << "mechane record: " << what << "\n";
    return 1;
  };
  auto client =
      client::Client::connect({.kiosk = options.kiosk, .program = "mechane-record", .domain = options.domain});
  if (!client) return fail_with(client.error().to_string());
  auto recorder = recording::FrameRecorder::create(options.file, options.recorder);
  if (!recorder) return fail_with(recorder.error().to_string());
  hear(**client, options, err, *recorder);
  if (!recorder->goes_on()) return 1;  // the log says why
  if (recorder->frames() == 0)
    return fail_with(
        fmt::format("{}: {} was in no world, so nothing can be played: check the kiosk's name, and that a "
                    "server runs in DDS domain {} (mechane doctor)",
                    options.file, options.kiosk, options.domain));
  err << fmt::format("mechane record: {} frames in {}\n", recorder->frames(), options.file);
  return 0;
}

}  // namespace mechane::cli
