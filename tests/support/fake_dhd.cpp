// A stub of Force Dimension's library with one device, written from the published table of its functions. A test loads
// the same file and finds the fake_dhd_* functions by name. No thread of its own.
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>

#define FAKE_DHD extern "C" __attribute__((visibility("default")))

namespace {

// What a test sets and reads, by name. SI; x to the user, y to the right, z up.
struct DhdCell {
  const char* name;
  double fresh;  // after fake_dhd_reset()
  double value = fresh;
};
std::array cells = {
    // what the device is
    DhdCell{"absent", 0}, DhdCell{"type", 33}, DhdCell{"max_force", -1}, DhdCell{"initialised", 1},
    DhdCell{"auto_init_fails", 0},
    // what it does now; `result` is what each call returns
    DhdCell{"x", 0}, DhdCell{"y", 0}, DhdCell{"z", 0}, DhdCell{"turn_about_z", 0}, DhdCell{"no_rotation", 0},
    DhdCell{"buttons", 0}, DhdCell{"result", 0}, DhdCell{"force_off_cause", 0}, DhdCell{"error", 0},
    // what it was told
    DhdCell{"index", -1}, DhdCell{"open", 0}, DhdCell{"fx", 9}, DhdCell{"fy", 9}, DhdCell{"fz", 9}, DhdCell{"tx", 9},
    DhdCell{"ty", 9}, DhdCell{"tz", 9}, DhdCell{"grip", 9}, DhdCell{"force_on", 0}, DhdCell{"brakes", 1},
    DhdCell{"gravity", 0}, DhdCell{"regulates", 0}, DhdCell{"auto_inits", 0}, DhdCell{"enables", 0},
    DhdCell{"misuse", 0}};

double& dhd_at(std::string_view name) {
  for (DhdCell& cell : cells)
    if (name == cell.name) return cell.value;
  std::abort();
}
constexpr char kDhdDevice = 3;

/// The result of a call to the device: -1 when it is not there, else what the test has set.
int answer(char id) {
  if (id != kDhdDevice || dhd_at("open") == 0) ++dhd_at("misuse");
  return dhd_at("absent") != 0 ? -1 : static_cast<int>(dhd_at("result"));
}

}  // namespace

FAKE_DHD void fake_dhd_set(const char* name, double value) {
  dhd_at(name) = value;
}
FAKE_DHD double fake_dhd_get(const char* name) {
  return dhd_at(name);
}
FAKE_DHD void fake_dhd_reset() {
  for (DhdCell& cell : cells)
    cell.value = cell.fresh;
}

FAKE_DHD int drdOpenID(char index) {
  dhd_at("index") = index;
  if (dhd_at("absent") != 0 || index > 1) return -1;
  ++dhd_at("open");
  return kDhdDevice;
}
FAKE_DHD int drdClose(char id) {
  const int result = answer(id);
  --dhd_at("open");
  return result;
}
FAKE_DHD bool drdIsInitialized(char id) {
  return answer(id) >= 0 && dhd_at("initialised") != 0;
}
FAKE_DHD int drdAutoInit(char id) {
  ++dhd_at("auto_inits");
  dhd_at("regulates") = 1;
  if (dhd_at("auto_init_fails") != 0) return -1;
  dhd_at("initialised") = 1;
  return answer(id);
}
FAKE_DHD int drdStop(bool, char id) {
  dhd_at("regulates") = 0;
  return answer(id);
}
FAKE_DHD int dhdGetSystemType(char id) {
  return answer(id) < 0 ? -1 : static_cast<int>(dhd_at("type"));
}
FAKE_DHD double dhdGetMaxForce(char) {
  return dhd_at("max_force");
}
FAKE_DHD int dhdSetGravityCompensation(int on, char id) {
  dhd_at("gravity") = on;
  return answer(id);
}
FAKE_DHD int dhdSetBrakes(int on, char id) {
  dhd_at("brakes") = on;
  return answer(id);
}
FAKE_DHD int dhdEnableForce(unsigned char on, char id) {
  ++dhd_at("enables");
  dhd_at("force_on") = on;
  if (on != 0) dhd_at("force_off_cause") = 0;
  return answer(id);
}
FAKE_DHD int dhdGetStatus(int* status, char id) {
  for (int i = 0; i < 17; ++i)
    status[i] = 0;
  status[5] = dhd_at("force_on") != 0 && dhd_at("force_off_cause") == 0;
  status[9] = static_cast<int>(dhd_at("error"));
  status[14] = static_cast<int>(dhd_at("force_off_cause"));
  return answer(id);
}
FAKE_DHD int dhdGetPosition(double* x, double* y, double* z, char id) {
  *x = dhd_at("x"), *y = dhd_at("y"), *z = dhd_at("z");
  return answer(id);
}
FAKE_DHD int dhdGetOrientationFrame(double (*m)[3], char id) {
  const double cosine = std::cos(dhd_at("turn_about_z")), sine = std::sin(dhd_at("turn_about_z"));
  m[0][0] = m[1][1] = cosine, m[1][0] = sine, m[0][1] = -sine;
  m[0][2] = m[1][2] = m[2][0] = m[2][1] = 0;
  m[2][2] = dhd_at("no_rotation") != 0 ? 0 : 1;
  return answer(id);
}
FAKE_DHD unsigned dhdGetButtonMask(char id) {
  return answer(id) < 0 ? 0 : static_cast<unsigned>(dhd_at("buttons"));
}
FAKE_DHD int dhdSetForce(double fx, double fy, double fz, char id) {
  dhd_at("fx") = fx, dhd_at("fy") = fy, dhd_at("fz") = fz;
  return answer(id);
}
FAKE_DHD int dhdSetForceAndTorqueAndGripperForce(double fx, double fy, double fz, double tx, double ty, double tz,
                                                 double grip, char id) {
  dhd_at("tx") = tx, dhd_at("ty") = ty, dhd_at("tz") = tz, dhd_at("grip") = grip;
  return dhdSetForce(fx, fy, fz, id);
}
FAKE_DHD const char* dhdErrorGetLastStr() {
  return dhd_at("absent") != 0 ? "fake: no device" : nullptr;
}
