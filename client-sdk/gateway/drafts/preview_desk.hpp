// Drafts that are being tried: each runs on a server of its own, in a DDS domain of its own, and is seen at a kiosk that only the author
// knows. STREAM.md and COMMANDS.md have the requests.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "client-sdk/gateway/browsers/backstage.hpp"
#include "client-sdk/gateway/browsers/kiosk_hub.hpp"
#include "client-sdk/gateway/drafts/played_visit.hpp"
#include "client-sdk/gateway/drafts/preview_process.hpp"
#include "client-sdk/studio/shelf/shelf.hpp"
#include "client-sdk/studio/view/stillness.hpp"

namespace mechane::gateway {

/// Which bodies have moved a moment ago, by the world's own time. Pure.
class MotionWatch {
 public:
  static constexpr std::uint64_t kMoment = 100;  ///< ticks

  /// Takes a frame of the world. Bodies that it does not have stand still.
  void look(const state::WorldDescription& world, const client::Frame& frame);
  /// Where the bodies are and which of them move, as far as frames tell; all move until two moments were seen.
  void tell(studio::SeenWorld& seen) const;

 private:
  std::uint64_t tick_ = 0;  ///< of `before_`
  std::vector<Pose> before_, now_;
  std::vector<std::uint8_t> visible_, moves_;
};

/// On the loop's thread.
class PreviewDesk {
 public:
  static constexpr std::size_t kMost = 4;        ///< at a time
  static constexpr std::uint32_t kDomains = 50;  ///< the first preview's DDS domain is so far from the gateway's
  static constexpr Duration kStaysUnseen = std::chrono::minutes(15);

  struct Places {
    std::filesystem::path server;  ///< the programs
    std::filesystem::path visitor;
    std::filesystem::path scenarios;  ///< the museum's exhibits; empty: nothing is ever tried
    /// Removes the file of a preview, after the work that the studio's thread has been given before.
    std::function<void(const std::filesystem::path&)> remove;
  };
  /// Removes what an earlier gateway has left.
  PreviewDesk(Places places, const Backstage& backstage);
  /// Ends all, and waits for it.
  ~PreviewDesk();
  PreviewDesk(const PreviewDesk&) = delete;
  PreviewDesk& operator=(const PreviewDesk&) = delete;

  /// Its name among kiosks: "studio-NAME", shorter where that would not be one.
  [[nodiscard]] static std::string kiosk_of(const std::string& draft);

  /// Before the draft's file is written. Errors: busy.
  [[nodiscard]] Expected<void> prepare(const std::string& draft);
  /// After it: starts a server with it, in the place of the one that runs. Null: the draft could not be laid out.
  void start(const std::string& draft, const studio::PreviewDraft* laid, TimePoint now);
  /// Errors: conflict (nothing runs, or time does not stand still), failed_process.
  [[nodiscard]] Expected<void> set_pace(const std::string& draft, double pace);
  [[nodiscard]] Expected<void> step(const std::string& draft, std::uint32_t ticks);
  /// A scripted visitor comes, in the place of one who is there, and time runs as in the museum. Without a name the visitor leaves.
  /// Errors: conflict (nothing runs), unknown_name (the running exhibit has no such visit), failed_process.
  [[nodiscard]] Expected<void> play(const std::string& draft, const std::string& visit);
  /// The draft as it is now has been laid out in the place of the one that runs, beginning at the same step: its server goes on with it
  /// from where it is, or says what keeps it from that. Errors: conflict (nothing runs, or a visitor plays), failed_process.
  [[nodiscard]] Expected<void> edit(const std::string& draft, studio::PreviewDraft laid);
  /// The step that the draft began at, where it runs and can be edited. Errors: those of edit().
  [[nodiscard]] Expected<std::string> editable(const std::string& draft);
  /// Asks the program of a device at this draft's kiosk, which answers in what look() tells. Errors: conflict (nothing runs, or no such
  /// device), io_failure.
  [[nodiscard]] Expected<void> ask_device(const std::string& draft, const client::DeviceRequest& request,
                                          TimePoint now);
  void stop(const std::string& draft);
  /// As JSON, for who looks at it. It ends when nobody has for a while.
  [[nodiscard]] std::string look(const std::string& draft, TimePoint now);

  /// Null where no preview has this kiosk, or its server is not there yet.
  [[nodiscard]] std::shared_ptr<KioskHub> hub_of(const std::string& kiosk) const;
  /// Call it two hundred times a second.
  void tick(TimePoint now);

 private:
  struct Preview {
    std::uint64_t number = 0;
    studio::PreviewDraft draft;
    std::string kiosk, token;
    std::uint32_t domain = 0;
    double pace = 1;
    std::unique_ptr<PreviewProcess> process;       ///< null: it has failed
    std::shared_ptr<const std::monostate> wanted;  ///< as long as its kiosk is to be opened
    std::shared_ptr<KioskHub> hub;
    std::vector<std::string> said;               ///< of one that has failed
    std::optional<studio::PreviewDraft> edited;  ///< its server has not answered yet
    std::int64_t kept_from = -1;                 ///< the newest revision that it did not go on with
    std::string kept_by;                         ///< and why: "body LOAD"
    MotionWatch motion;
    std::uint64_t visits = 0;           ///< that were played
    std::optional<PlayedVisit> played;  ///< the last one
    TimePoint looked;
  };
  struct Ending {
    std::uint32_t domain = 0;
    std::unique_ptr<PreviewProcess> process;
  };
  using Previews = std::map<std::string, Preview>;

  [[nodiscard]] Expected<Preview*> running(const std::string& draft);
  [[nodiscard]] static Expected<void> order(const Preview& preview, const std::string& line);
  [[nodiscard]] std::uint32_t free_domain() const;
  [[nodiscard]] Previews::iterator find(std::uint64_t number);
  void open(const Preview& preview);
  void opened(std::uint64_t number, std::shared_ptr<client::DisplaySeats> seats);
  void ended(std::uint64_t number);
  static void hear_edits(Preview& preview, std::vector<std::string>& said);
  void end_visit(Preview& preview);
  void visit_ended(std::uint64_t number, std::uint64_t visit);
  void close(const std::string& draft, Preview& preview, const std::string& why);

  const Places places_;
  const Backstage backstage_;
  Previews previews_;
  std::set<std::string> preparing_;
  std::vector<Ending> ending_;
  std::uint64_t numbers_ = 0;
};

}  // namespace mechane::gateway
