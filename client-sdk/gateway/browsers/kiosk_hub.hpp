// One kiosk in use: one client for all of its browsers. Frames are encoded once, and texts once where they are the same for
// all. On the loop's thread.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "client-sdk/gateway/browsers/asked_devices.hpp"
#include "client-sdk/gateway/browsers/backstage.hpp"
#include "client-sdk/gateway/browsers/browser.hpp"
#include "client-sdk/visit/calibration_guide.hpp"
#include "client-sdk/visit/device_notice.hpp"
#include <mechane/client/client.hpp>

namespace mechane::gateway {

class KioskHub : public std::enable_shared_from_this<KioskHub> {
 public:
  KioskHub(std::string kiosk, const Backstage& backstage);
  ~KioskHub();
  KioskHub(const KioskHub&) = delete;
  KioskHub& operator=(const KioskHub&) = delete;

  /// Opens the client, on another thread.
  void open();
  void join(const std::shared_ptr<Browser>& browser);
  void leave(const Browser& browser);
  /// All browsers leave, and are told why.
  void part(const std::string& reason, const std::string& remedy);
  /// Sends what is new. Call it two hundred times a second.
  void tick(TimePoint now);

  [[nodiscard]] const std::string& kiosk() const { return kiosk_; }
  [[nodiscard]] const Backstage& backstage() const { return backstage_; }
  [[nodiscard]] std::size_t browsers() const { return browsers_.size(); }
  /// When the last browser left, or somebody asked for the client.
  [[nodiscard]] TimePoint used() const { return used_; }
  void use(TimePoint now) { used_ = now; }
  /// "web-1", "web-2" ...: not used by another browser of the kiosk since the hub was made.
  [[nodiscard]] std::string next_display() { return "web-" + std::to_string(++displays_); }

  /// Null until it is open.
  [[nodiscard]] client::Client* client() const { return client_.get(); }
  [[nodiscard]] const client::WorldStatus* status() const { return status_ ? &*status_ : nullptr; }
  [[nodiscard]] const std::shared_ptr<const client::WorldPresentation>& presentation() const { return presentation_; }
  [[nodiscard]] const client::Frame* frame() const { return frame_ ? &*frame_ : nullptr; }
  [[nodiscard]] client::LinkState link() const { return client_ ? client_->state() : client::LinkState::searching; }
  [[nodiscard]] pointer::PointerWorld world() const;
  [[nodiscard]] const visit::DeviceNotice& devices() const { return devices_; }
  [[nodiscard]] AskedDevices& asked_devices() { return asked_devices_; }
  /// See asked_devices.hpp; empty until the client is open.
  [[nodiscard]] nlohmann::json devices_json(TimePoint now) const;
  [[nodiscard]] const visit::CalibrationGuide& calibration() const { return calibration_; }
  [[nodiscard]] double frames_per_s() const { return frames_per_s_; }
  /// Whether the world refused a command that client() sent.
  [[nodiscard]] bool refused(std::uint64_t command) const { return refused_.contains(command); }

 private:
  void take_frame();
  void take_news(TimePoint now);
  void take_world();
  void publish(const std::string& kind, std::string text);

  const std::string kiosk_;
  const Backstage backstage_;
  std::unique_ptr<client::Client> client_;
  std::vector<std::shared_ptr<Browser>> browsers_;
  std::map<std::string, std::shared_ptr<const std::string>> texts_;  ///< the newest of each kind
  std::optional<client::WorldStatus> status_;
  std::shared_ptr<const client::WorldPresentation> presentation_;
  std::vector<client::SceneObject> objects_;
  std::optional<client::Frame> frame_;
  client::Frame newest_;
  std::uint64_t frames_ = 0, frames_before_ = 0;
  double frames_per_s_ = 0;
  std::set<std::uint64_t> refused_;
  visit::DeviceNotice devices_;
  std::vector<client::DeviceReport> device_reports_;
  AskedDevices asked_devices_;
  visit::CalibrationGuide calibration_;
  TimePoint used_, next_news_, next_follow_, next_refresh_, next_report_;
  int displays_ = 0;
};

}  // namespace mechane::gateway
