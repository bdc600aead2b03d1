// A stub of the HD library with one arm, written from the published table of its functions. A test loads the same file,
// finds the fake_hd_* functions by name, and turns the scheduler's ticks by hand, or lets a thread turn them.
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <thread>
#include <utility>

#define FAKE_HD extern "C" __attribute__((visibility("default")))

namespace {

// What a test sets and reads, by name. Lengths in mm, forces in N, torques in mN m.
struct Cell {
  const char* name;
  double fresh;  // after fake_hd_reset()
  std::atomic<double> value{fresh};
};
std::array cells = {
    // what the arm is
    Cell{"init_error", 0}, Cell{"style", 4}, Cell{"input_dof", 6}, Cell{"output_dof", 3}, Cell{"max_force", 3.3},
    Cell{"continuous_force", 0.88}, Cell{"stiffness", 0.5}, Cell{"torque", 188}, Cell{"centre_y", 0},
    Cell{"no_temperature", 0}, Cell{"no_rate", 0}, Cell{"never_ticks", 0},
    // what it does now
    Cell{"x", 0}, Cell{"y", 0}, Cell{"z", 0}, Cell{"turn_about_y", 0}, Cell{"buttons", 0}, Cell{"temperature", 0},
    Cell{"undocked", 1}, Cell{"calibration", 0x5000}, Cell{"update_helps", 1},
    // an error at the end of the next frame, and the one that came before it
    Cell{"error", 0}, Cell{"internal", 0}, Cell{"cause", 0},
    // what it was told
    Cell{"fx", 0}, Cell{"fy", 0}, Cell{"fz", 0}, Cell{"tx", 0}, Cell{"ty", 0}, Cell{"tz", 0}, Cell{"ticks", 0},
    Cell{"updates", 0}, Cell{"update_style", 0}, Cell{"updates_in_force", 0}, Cell{"misuse", 0}, Cell{"unscheduled", 0},
    Cell{"named", 0}, Cell{"rate", 1000}, Cell{"running", 0}, Cell{"open", 0}, Cell{"enabled", 0}, Cell{"priority", 0}};

std::atomic<double>& at(std::string_view name) {
  for (Cell& cell : cells)
    if (name == cell.name) return cell.value;
  std::abort();
}
unsigned whole(std::string_view name) {
  return static_cast<unsigned>(at(name).load());
}
void count(std::string_view name) {
  at(name) = at(name) + 1;
}

struct Info {
  unsigned code;
  int internal;
  unsigned device;
};
constexpr unsigned kDevice = 7;

// One session; touched by the thread that turns the ticks, or by the test's while none turns.
struct Session {
  std::array<Info, 16> stack{};
  std::size_t depth = 0;
  bool in_frame = false;
  std::array<double, 3> force{}, torque{};
  unsigned (*callback)(void*) = nullptr;
  void* user = nullptr;
  std::thread thread;
  std::atomic<bool> turning{false};
} session;

void push(unsigned code, int internal = 0) {
  if (session.depth < session.stack.size()) session.stack[session.depth++] = {code, internal, kDevice};
}
void misuse(unsigned code) {
  count("misuse");
  push(code);
}
void turn() {
  if (at("running") == 0 || session.callback == nullptr) return;
  count("ticks");
  if (session.callback(session.user) == 0) session.callback = nullptr;
}
void stop_turning() {
  session.turning = false;
  if (session.thread.joinable()) session.thread.join();
}

}  // namespace

FAKE_HD void fake_hd_set(const char* name, double value) {
  at(name) = value;
}
FAKE_HD double fake_hd_get(const char* name) {
  return at(name);
}
FAKE_HD void fake_hd_turn(int ticks) {
  for (int i = 0; i < ticks; ++i)
    turn();
}
/// From now on a thread turns a tick each ms, until the scheduler is stopped.
FAKE_HD void fake_hd_run() {
  session.turning = true;
  session.thread = std::thread([] {
    while (session.turning) {
      turn();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // sleeps: the pace of the scheduler
    }
  });
}
FAKE_HD void fake_hd_reset() {
  stop_turning();
  for (Cell& cell : cells)
    cell.value = cell.fresh;
  session.depth = 0;
  session.callback = nullptr;
}

FAKE_HD unsigned hdInitDevice(const char* name) {
  at("named") = name == nullptr ? 0 : std::strcmp(name, "Left Arm") == 0 ? 1 : 2;
  if (at("init_error") != 0) {
    push(whole("init_error"), static_cast<int>(at("internal")));
    return 0xFFFFFFFF;
  }
  count("open");
  return kDevice;
}
FAKE_HD void hdDisableDevice(unsigned device) {
  if (device != kDevice || at("open") == 0) misuse(0x104);
  if (at("running") != 0) misuse(0x102);  // the scheduler is stopped first
  at("open") = at("open") - 1;
}
FAKE_HD void hdBeginFrame(unsigned device) {
  if (device != kDevice || session.in_frame) misuse(0x400);
  session.in_frame = true;
  session.force = session.torque = {};
}
FAKE_HD void hdEndFrame(unsigned device) {
  if (device != kDevice || !session.in_frame) misuse(0x401);
  session.in_frame = false;
  at("fx") = session.force[0], at("fy") = session.force[1], at("fz") = session.force[2];
  at("tx") = session.torque[0], at("ty") = session.torque[1], at("tz") = session.torque[2];
  if (const unsigned cause = static_cast<unsigned>(at("cause").exchange(0)); cause != 0)
    push(cause, static_cast<int>(at("internal")));
  if (const unsigned error = static_cast<unsigned>(at("error").exchange(0)); error != 0)
    push(error, static_cast<int>(at("internal")));
}

FAKE_HD void hdGetBooleanv(unsigned what, unsigned char* value) {
  if (what != 0x2002) return misuse(0x100);
  *value = at("undocked") != 0;
}
FAKE_HD void hdGetIntegerv(unsigned what, int* value) {
  for (const auto& [code, name] :
       {std::pair{0x2000u, "buttons"}, {0x2553u, "input_dof"}, {0x2554u, "output_dof"}, {0x2555u, "style"}})
    if (what == code) {
      *value = static_cast<int>(at(name));
      return;
    }
  misuse(0x100);
}
namespace {
/// By columns, with the translation last; a turn about y.
void transform(double* value) {
  const double angle = at("turn_about_y");
  const double cosine = __builtin_cos(angle), sine = __builtin_sin(angle);
  const std::array<double, 16> columns = {cosine, 0, -sine,  0, 0,       1,       0,       0,
                                          sine,   0, cosine, 0, at("x"), at("y"), at("z"), 1};
  std::memcpy(value, columns.data(), sizeof columns);
}
}  // namespace
FAKE_HD void hdGetDoublev(unsigned what, double* value) {
  switch (what) {
    case 0x2050:
      value[0] = at("x"), value[1] = at("y"), value[2] = at("z");
      return;
    case 0x2052:
      return transform(value);
    case 0x2551:
      value[0] = -80, value[1] = at("centre_y") - 60, value[2] = -35;
      value[3] = 80, value[4] = at("centre_y") + 60, value[5] = 35;
      return;
    case 0x2602:
      *value = at("stiffness");
      return;
    case 0x2603:
      *value = at("max_force");
      return;
    case 0x2604:
      *value = at("continuous_force");
      return;
    case 0x2605:
      if (at("no_temperature") != 0) return push(0x100);
      value[0] = value[2] = 0.1, value[1] = at("temperature");  // of three motors: the others are left as they were
      return;
    case 0x2609:
      *value = 0.004;
      return;
    case 0x2622:
      *value = at("torque");
      return;
    default:
      misuse(0x100);
  }
}
FAKE_HD void hdSetDoublev(unsigned what, const double* value) {
  if (!session.in_frame) return misuse(0x102);
  if (what == 0x2700)
    std::memcpy(session.force.data(), value, sizeof session.force);
  else if (what == 0x2701 && at("output_dof") == 6)
    std::memcpy(session.torque.data(), value, sizeof session.torque);
  else
    misuse(0x100);
}
FAKE_HD const char* hdGetString(unsigned what) {
  return what == 0x2503 ? "Fake" : what == 0x2501 ? "Arm" : nullptr;
}
FAKE_HD void hdEnable(unsigned what) {
  if (what == 0x4000) at("enabled") = 1;
  if (what == 0x4002) push(0x100);  // this model has no ramp
}
FAKE_HD Info hdGetError() {
  return session.depth == 0 ? Info{0, 0, 0xFFFFFFFF} : session.stack[--session.depth];
}
FAKE_HD const char* hdGetErrorString(unsigned code) {
  return code == 0x302 ? "Fake communication error" : nullptr;
}
FAKE_HD unsigned hdCheckCalibration() {
  return whole("calibration");
}
FAKE_HD void hdUpdateCalibration(unsigned style) {
  count("updates");
  at("update_style") = style;
  if (at("fx") != 0 || at("fy") != 0 || at("fz") != 0) count("updates_in_force");
  if (at("update_helps") != 0)
    at("calibration") = 0x5000;
  else
    push(0x102);
}
/// Turns the first tick itself.
FAKE_HD void hdStartScheduler() {
  at("running") = 1;
  if (at("never_ticks") == 0) turn();
}
FAKE_HD void hdStopScheduler() {
  stop_turning();
  at("running") = 0;
}
FAKE_HD void hdSetSchedulerRate(unsigned long rate) {
  if (at("no_rate") != 0) return push(0x101);
  at("rate") = static_cast<double>(rate);
}
FAKE_HD unsigned long hdScheduleAsynchronous(unsigned (*callback)(void*), void* user, unsigned short priority) {
  session.callback = callback;
  session.user = user;
  at("priority") = priority;
  return 1;
}
FAKE_HD void hdUnschedule(unsigned long) {
  count("unscheduled");
  session.callback = nullptr;
}
