// CyberGrasp by a library of the museum's own around the maker's VirtualHand SDK (see shim.h): it pulls the fingers
// open by tendons, and reads the hand where that library has the angles of the CyberGlove beneath. Facts:
// vhtCyberGrasp.h 1.22 in public copies. Never run on hardware. Another program that renders in mode force too is not
// noticed. What happens without faults allocates nothing here; the library may.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <string>

#include <poll.h>

#include "client-sdk/drivers/cyberglove/calibration.hpp"
#include "client-sdk/drivers/cybergrasp/api.hpp"
#include "client-sdk/drivers/cybergrasp/convert.hpp"
#include "client-sdk/drivers/driver_class.hpp"

namespace mechane::drivers {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kGraspFresh = 50ms;     // a hand is of now: no pull on an older one
constexpr auto kGraspSilence = 100ms;  // without the mode, the angles or the place: a fault
constexpr auto kGraspStart = 1s;
constexpr int kGraspLookMs = 5;           // while open() waits
constexpr double kFullPull_n = 12;        // of the maker, as quoted everywhere
constexpr double kGreatestFinger_n = 40;  // of driver.h

class CyberGrasp {
 public:
  static constexpr const char* kSummary =
      "CyberGrasp, by a library around the maker's VirtualHand SDK that a museum builds; it pulls the fingers open";
  static constexpr const char* kOptions = "library=FILE host=NAME hand=right|left joints=yes|no full=NEWTONS";

  CyberGrasp() = default;
  ~CyberGrasp() { close(); }
  CyberGrasp(const CyberGrasp&) = delete;
  CyberGrasp& operator=(const CyberGrasp&) = delete;

  Fault open(Options& options);
  Fault describe(mechane_device_info& info);
  Fault read(mechane_device_state& state);
  Fault write(const mechane_device_force& force);

 private:
  Fault take_over();
  Fault look();
  Fault look_at_mode();
  Fault look_at_joints();
  Fault look_at_pose();
  Fault pull(const std::array<double, MECHANE_FINGERS>& pulls);
  [[nodiscard]] bool ready(Clock::time_point now) const;
  [[nodiscard]] Fault failed(const std::string& what) const;
  [[nodiscard]] Fault lost(const std::string& what) const {
    return failed(what) + ". Check its controller, the device manager and the network; it is opened again by itself";
  }
  [[nodiscard]] Fault slow(Clock::time_point since) const;
  void close() noexcept;

  cybergrasp::Api grasp_;
  mechane_grasp* glove_ = nullptr;
  std::uint32_t side_ = MECHANE_HAND_RIGHT;
  bool wants_joints_ = true;
  bool tracked_ = false;  // a tracker has given a place
  double full_n_ = kFullPull_n;
  int mode_ = 0;
  // When the mode was force, and when the angles and the place came, last.
  Clock::time_point force_at_{}, joints_at_{}, pose_at_{};
  mechane_device_state last_{};
};

Fault CyberGrasp::open(Options& options) {
  const std::string library = options.text("library", "");
  const std::string host = options.text("host", "");
  side_ = options.hand_side();
  wants_joints_ = options.choice("joints", {"yes", "no"}) == 0;
  full_n_ = options.number("full", kFullPull_n, 1, kGreatestFinger_n);
  if (!options.fault().empty()) return options.fault();
  if (Fault fault = cybergrasp::load(grasp_, library); !fault.empty()) return fault;
  if (wants_joints_ && grasp_.joints == nullptr)
    return library +
           " has no mechane_grasp_joints, so that the hand would stay open in the world. With joints=no the glove "
           "is used all the same";
  glove_ = grasp_.open(host.empty() ? nullptr : host.c_str());
  if (glove_ == nullptr)
    return failed("the CyberGrasp does not open") +
           ". Check that its controller is on, that the device manager runs, and the option host";
  last_.orientation_wxyz[0] = 1;
  last_.temperature = -1;
  return take_over();
}

/// No force before the mode too, for the controller may hold one of a program before.
Fault CyberGrasp::take_over() {
  if (Fault fault = pull({}); !fault.empty()) return fault;
  if (grasp_.set_mode(glove_, MECHANE_GRASP_FORCE) != 0)
    return failed("the CyberGrasp does not go into mode force") + ". Switch its controller off and on";
  if (Fault fault = pull({}); !fault.empty()) return fault;
  const auto begun = force_at_ = joints_at_ = Clock::now();
  Fault fault;
  do {
    fault = look();
    if (fault.empty() && ready(Clock::now())) return {};
    ::poll(nullptr, 0, kGraspLookMs);
  } while (Clock::now() - begun < kGraspStart);
  return fault.empty() ? look() : fault;
}

Fault CyberGrasp::describe(mechane_device_info& info) {
  std::snprintf(info.name, sizeof info.name, "CyberGrasp, %s hand%s", name_of_side(side_),
                wants_joints_ ? "" : ", without the hand's angles");
  info.hand = MECHANE_HAND_GLOVE;
  info.side = side_;
  info.output = MECHANE_OUTPUT_FINGER_PULL;
  info.peak_finger_force_n = full_n_;
  info.rate_hz = 200;  // the glove has 90 to 150 records a second
  return {};
}

Fault CyberGrasp::read(mechane_device_state& state) {
  if (Fault fault = look(); !fault.empty()) return fault;
  state = last_;
  if (ready(Clock::now())) state.flags = MECHANE_STATE_READY;
  return {};
}

Fault CyberGrasp::look() {
  const auto begun = Clock::now();
  if (Fault fault = look_at_mode(); !fault.empty()) return fault;
  if (Fault fault = look_at_joints(); !fault.empty()) return fault;
  if (Fault fault = look_at_pose(); !fault.empty()) return fault;
  return slow(begun);
}

Fault CyberGrasp::look_at_mode() {
  if (grasp_.get_mode(glove_, &mode_) != 0) return lost("the CyberGrasp does not report its mode");
  const auto now = Clock::now();
  if (mode_ == MECHANE_GRASP_FORCE) force_at_ = now;
  if (now - force_at_ <= kGraspSilence) return {};
  return "another program has put the CyberGrasp into the mode '" + cybergrasp::name_of_mode(mode_) +
         "'. End that program; the glove is opened again by itself";
}

/// Angles that no hand has are skipped.
Fault CyberGrasp::look_at_joints() {
  if (!wants_joints_) return {};
  std::array<double, MECHANE_HAND_JOINTS> joints{};
  const int came = grasp_.joints(glove_, joints.data());
  if (came < 0) return lost("the hand's angles do not come");
  const auto now = Clock::now();
  if (came == 1 && cybergrasp::are_joints(joints)) {
    std::copy(joints.begin(), joints.end(), last_.joints_rad);
    last_.grasp = grasp_of(last_.joints_rad);
    joints_at_ = now;
  }
  if (now - joints_at_ <= kGraspSilence) return {};
  return came == 1
             ? "the hand's angles have been no numbers, or impossible, for 0.1 s. Calibrate the CyberGlove in the "
               "maker's program, in radians; check its cable"
             : "the hand's angles have not come for 0.1 s. Check that the CyberGlove is on and its cable; with "
               "joints=no the CyberGrasp is used without them";
}

Fault CyberGrasp::look_at_pose() {
  if (grasp_.pose == nullptr) return {};
  std::array<double, 3> position{};
  std::array<double, 4> wxyz{};
  const int came = grasp_.pose(glove_, position.data(), wxyz.data());
  if (came < 0) return lost("the hand's place does not come");
  const auto now = Clock::now();
  if (came == 1 && cybergrasp::is_pose(position, wxyz)) {
    std::copy(position.begin(), position.end(), last_.position_m);
    std::copy(wxyz.begin(), wxyz.end(), last_.orientation_wxyz);
    pose_at_ = now;
    tracked_ = true;
  }
  if (!tracked_ || now - pose_at_ <= kGraspSilence) return {};
  return "the hand's place has not come from the tracker, or is impossible, for 0.1 s. Check the tracker and its cable";
}

bool CyberGrasp::ready(Clock::time_point now) const {
  return mode_ == MECHANE_GRASP_FORCE && (!wants_joints_ || now - joints_at_ <= kGraspFresh) &&
         (!tracked_ || now - pose_at_ <= kGraspFresh);
}

/// In another mode nothing is set, not even zero: it would bring the mode force back over the other program.
Fault CyberGrasp::write(const mechane_device_force& force) {
  if (mode_ != MECHANE_GRASP_FORCE) return {};
  const bool may = ready(Clock::now());
  return pull(may ? cybergrasp::pulls_of(force.finger_n, full_n_) : std::array<double, MECHANE_FINGERS>{});
}

Fault CyberGrasp::pull(const std::array<double, MECHANE_FINGERS>& pulls) {
  const auto begun = Clock::now();
  if (grasp_.set_forces(glove_, pulls.data()) != 0) return lost("the CyberGrasp takes no force");
  return slow(begun);
}

Fault CyberGrasp::slow(Clock::time_point since) const {
  const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - since);
  if (took <= kGraspSilence) return {};
  return "the CyberGrasp took " + std::to_string(took.count()) +
         " ms to answer. Check the network to its controller, and that its computer is not overloaded";
}

/// Whatever mode it is in: a visitor's hand is in the glove.
void CyberGrasp::close() noexcept {
  if (glove_ == nullptr) return;
  constexpr std::array<double, MECHANE_FINGERS> kNone{};
  (void)grasp_.set_forces(glove_, kNone.data());
  (void)grasp_.rewind(glove_);
  grasp_.close(glove_);
}

Fault CyberGrasp::failed(const std::string& what) const {
  const char* why = grasp_.error(glove_);
  return what + ": '" + (why == nullptr || *why == '\0' ? "unknown error" : why) + "'";
}

}  // namespace
}  // namespace mechane::drivers

MECHANE_EXPORT_DRIVER(mechane::drivers::CyberGrasp)
