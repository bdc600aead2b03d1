#include "client-sdk/cli/doctor_devices.hpp"

#include <fstream>
#include <iterator>
#include <ostream>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "client-sdk/cli/device_facts.hpp"
#include "server/base/program_folder.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_folder.hpp"

namespace mechane::realtime {
/// For GoogleTest.
void PrintTo(const CheckResult& result, std::ostream* out) {
  *out << name_of(result.status) << " " << result.name << ": " << result.found << "; remedy: " << result.remedy;
}
}  // namespace mechane::realtime

namespace mechane::cli {
namespace {

namespace fs = std::filesystem;
using realtime::CheckResult;
using realtime::CheckStatus;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::Not;

auto is(CheckStatus status) {
  return Field("status", &CheckResult::status, status);
}
auto finds(const std::string& part) {
  return Field("found", &CheckResult::found, HasSubstr(part));
}
auto advises(const std::string& part) {
  return Field("remedy", &CheckResult::remedy, HasSubstr(part));
}
auto is_about(const std::string& name) {
  return Field("name", &CheckResult::name, name);
}

/// A folder that stands for "/". Its files belong to the test's own user and group; who wants to open devices is another user.
class DoctorDevicesTest : public testing::Test {
 protected:
  DoctorDevicesTest() {
    ada_.name = "ada";
    ada_.user = geteuid() + 4242;
    struct stat status {};
    EXPECT_EQ(stat(scratch_.write("probe", "").c_str(), &status), 0);
    ours_ = status.st_gid;
    groups("mechane-devices", "dialout");
    drivers({{"cyberglove", ""}, {"dhd", ""}, {"haply", ""}, {"lucidgloves", ""}, {"openhaptics", ""}});
  }

  void write(const std::string& path, const std::string& text) {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text << "\n";
  }
  /// The group of all files here, and one that is not.
  void groups(const std::string& of_files, const std::string& other) {
    write("etc/group", fmt::format("{}:x:{}:\n{}:x:{}:", of_files, ours_, other, ours_ + 1));
  }
  void drivers(const Values& faults) {
    nlohmann::json list = {{{"name", "virtual"}, {"fault", ""}}};
    for (const auto& [name, fault] : faults)
      list.push_back({{"name", name}, {"fault", fault}});
    program_ = scratch_.script("mechane-devices", "cat << 'END'\n" + list.dump() + "\nEND");
  }
  void kiosk(const std::string& device) {
    write("etc/mechane/haptic-kiosk-1", "# the device\nDEVICE=" + device + "\nOPTIONS=--center 0 0.9 0.3");
  }
  /// Another device, at the same kiosk where `more` says so.
  void second(const std::string& device, const std::string& more) {
    write("etc/mechane/haptic-kiosk-1-left", more + "\nDEVICE=" + device);
  }
  void node(const std::string& path, mode_t mode) {
    write(path, "");
    ASSERT_EQ(chmod((root_ / path).c_str(), mode), 0);
  }
  void plug_in(const std::string& vendor, const std::string& product, const std::string& line = "") {
    const std::string device = "sys/bus/usb/devices/1-2/";
    write(device + "idVendor", vendor);
    write(device + "idProduct", product);
    write(device + "busnum", "1");
    write(device + "devnum", "4");
    fs::create_directories(root_ / (device + "1-2:1.0/" + line));
  }
  void open_in(const std::string& process, const std::string& program, const std::string& file) {
    write("proc/" + process + "/comm", program);
    fs::create_directories(root_ / "proc" / process / "fd");
    fs::create_symlink(file, root_ / "proc" / process / "fd/7");
  }
  /// What holds of every report holds here: what is wrong has a remedy, and nothing is said twice.
  std::vector<CheckResult> results() {
    const auto found = check_devices({root_, program_, haptic_, ada_});
    std::set<std::string> said;
    for (const CheckResult& r : found) {
      EXPECT_EQ(r.remedy.empty(), r.status == CheckStatus::ok) << r.name << ": " << r.found;
      EXPECT_FALSE(r.name.empty() || r.found.empty() || r.wanted.empty()) << r.name << ": " << r.found;
      EXPECT_TRUE(said.insert(r.name + r.found).second) << r.name << ": " << r.found;
    }
    return found;
  }

  const test::ScratchFolder scratch_;
  const fs::path& root_ = scratch_.path();
  fs::path program_;
  fs::path haptic_ = program_folder() / "mechane-haptic";  // the program itself
  Account ada_;
  gid_t ours_ = 0;
};

TEST_F(DoctorDevicesTest, AMachineWithoutDevicesHasOneLineWhichIsFine) {
  write("etc/mechane/environment", "A=B");
  write("sys/bus/usb/devices/usb1/idVendor", "1d6b");
  EXPECT_THAT(results(), ElementsAre(is(CheckStatus::ok)));
  program_ = root_ / "none";  // a server may have no programs for devices
  EXPECT_THAT(results(), ElementsAre(is(CheckStatus::ok)));
}

TEST_F(DoctorDevicesTest, AKiosksGloveThatCanBeOpenedOrIsInUseIsFine) {
  groups("dialout", "mechane-devices");
  kiosk("lucidgloves:port=/dev/ttyUSB0,hand=left");
  node("dev/ttyUSB0", 0660);
  plug_in("10c4", "ea60", "ttyUSB0/tty/ttyUSB0");  // the kiosk tells about it
  EXPECT_THAT(results(), ElementsAre(AllOf(is(CheckStatus::ok), is_about("device of kiosk-1"), finds("/dev/ttyUSB0"))));
  open_in("812", "mechane-devices", "/dev/ttyUSB0");
  EXPECT_THAT(results(), ElementsAre(AllOf(is(CheckStatus::ok), finds("mechane-devices"), finds("812"))));
  kiosk("virtual");
  fs::remove_all(root_ / "sys");
  EXPECT_THAT(results(), ElementsAre(is(CheckStatus::ok)));
}

TEST_F(DoctorDevicesTest, ADriverMayBeMissingOrOfAnotherVersion) {
  kiosk("'falcon:serial=4711' ");
  EXPECT_THAT(results(), ElementsAre(AllOf(is(CheckStatus::bad), finds("'falcon'"), finds("lucidgloves"),
                                           advises("/etc/mechane/haptic-kiosk-1"))));
  drivers({{"falcon", "the driver is for another version"}});
  EXPECT_THAT(results(),
              ElementsAre(AllOf(is(CheckStatus::bad), is_about("device of kiosk-1"), finds("another version"))));
  kiosk("virtual");
  EXPECT_THAT(results(),
              Contains(AllOf(is(CheckStatus::warning), is_about("driver falcon"), finds("another version"))));
  kiosk("/opt/falcon.so");
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::bad), finds("/opt/falcon.so"))));
  write("opt/falcon.so", "");
  EXPECT_THAT(results(), Not(Contains(is(CheckStatus::bad))));
  write("etc/mechane/haptic-kiosk-1", "OPTIONS=--user 1");
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::bad), finds("/etc/mechane/haptic-kiosk-1"))));
}

TEST_F(DoctorDevicesTest, DriversThatBreakTheirProgramAreNoMissingDrivers) {
  kiosk("falcon");
  program_ = scratch_.script("broken", "kill -SEGV $$");
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::bad), is_about("drivers"), finds("broken"))));
  EXPECT_THAT(results(), Not(Contains(finds("'falcon'"))));
  program_ = root_ / "none";
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::bad), is_about("drivers"), finds("none"))));
}

TEST_F(DoctorDevicesTest, TheMakersLibraryMayBeMissingOrDamaged) {
  plug_in("1451", "0402");
  node("dev/bus/usb/001/004", 0660);
  kiosk("dhd:library=/opt/lib drd.so");
  EXPECT_THAT(results(),
              Contains(AllOf(is(CheckStatus::bad), is_about("device of kiosk-1"), finds("/opt/lib drd.so"))));
  write("opt/lib drd.so", std::string(1000, 'x'));
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::bad), finds("ELF"))));
  kiosk("dhd:library=libc.so.6");
  EXPECT_THAT(results(), Each(is(CheckStatus::ok)));
}

TEST_F(DoctorDevicesTest, AKiosksDeviceMayNotBePluggedIn) {
  kiosk("dhd:library=libc.so.6");
  EXPECT_THAT(results(),
              ElementsAre(AllOf(is(CheckStatus::bad), finds("0403:cb48"), advises("cable"), advises("lsusb"))));
  plug_in("0403", "6001");  // of the same maker, another thing
  EXPECT_THAT(results(), ElementsAre(is(CheckStatus::bad)));
  plug_in("0403", "cb48");
  node("dev/bus/usb/001/004", 0660);
  EXPECT_THAT(results(), Each(is(CheckStatus::ok)));
  kiosk("openhaptics:library=libc.so.6");
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::bad), finds("Touch"))));
  write("sys/bus/firewire/devices/fw0/is_local", "1");
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::bad), finds("Touch"))));
  write("sys/bus/firewire/devices/fw1/is_local", "0");
  node("dev/fw1", 0660);
  EXPECT_THAT(results(), Not(Contains(is(CheckStatus::bad))));
}

TEST_F(DoctorDevicesTest, ARightThatTheKioskLacksIsNamedWithTheStepsThatGiveIt) {
  kiosk("dhd:library=libc.so.6");
  plug_in("0403", "cb48");
  node("dev/bus/usb/001/004", 0600);
  write("etc/passwd", fmt::format("eva:x:{}:0::/:", geteuid()));
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::bad), is_about("Novint Falcon"), finds("/dev/bus/usb/001/004"),
                                        finds("eva"), finds("mechane-devices"), finds("0600"),
                                        advises("90-mechane-devices.rules"), advises("udevadm"))));
  write("etc/udev/rules.d/90-mechane-devices.rules", "");
  EXPECT_THAT(results(),
              Contains(AllOf(is(CheckStatus::bad), Not(advises("90-mechane-devices.rules")), advises("udevadm"))));
  write("etc/group", "");
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::bad), is_about("Novint Falcon"), finds(std::to_string(ours_)),
                                        advises("groupadd --system mechane-devices"))));
  groups("plugdev", "mechane-devices");
  node("dev/bus/usb/001/004", 0660);
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::bad), finds("plugdev"))));
  groups("mechane-devices", "dialout");
  EXPECT_THAT(results(), Each(is(CheckStatus::ok)));
  fs::remove(root_ / "dev/bus/usb/001/004");
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::bad), finds("/dev/bus/usb/001/004"))));
}

TEST_F(DoctorDevicesTest, WhoTriesADeviceByHandNeedsItsGroup) {
  plug_in("2988", "0302", "tty/ttyACM0");
  node("dev/ttyACM0", 0660);
  const auto lacks = AllOf(is(CheckStatus::warning), is_about("3D Systems Touch"), finds("ada"), finds("/dev/ttyACM0"));
  EXPECT_THAT(results(), Contains(AllOf(lacks, advises("usermod -aG mechane-devices ada"), Not(advises("udevadm")))));
  ada_.groups = {ours_};
  EXPECT_THAT(results(), Not(Contains(lacks)));
  node("dev/ttyACM0", 0640);
  EXPECT_THAT(results(), Contains(AllOf(lacks, Not(advises("usermod")), advises("udevadm"))));
}

TEST_F(DoctorDevicesTest, ATouchIsOpenedByTheFileThatLinuxHasMadeForIt) {
  kiosk("openhaptics:library=libc.so.6");
  plug_in("2988", "0303");
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::bad), is_about("3D Systems Touch"), finds("/dev"))));
  plug_in("2988", "0303", "0003:2988:0303.0001/hidraw/hidraw0");
  node("dev/hidraw0", 0600);
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::bad), finds("/dev/hidraw0"))));
  node("dev/hidraw0", 0660);
  EXPECT_THAT(results(), Each(is(CheckStatus::ok)));
}

TEST_F(DoctorDevicesTest, AnotherProgramAtTheDeviceIsNamed) {
  groups("dialout", "mechane-devices");
  const std::string link = "dev/serial/by-id/usb-glove";
  kiosk("lucidgloves:port=/" + link);
  node("dev/ttyUSB3", 0660);
  fs::create_directories((root_ / link).parent_path());
  fs::create_symlink("../../ttyUSB3", root_ / link);
  open_in("77", "cat", "/dev/ttyUSB33");
  EXPECT_THAT(results(), Each(is(CheckStatus::ok)));
  open_in("512", "ModemManager", "/dev/ttyUSB3");
  EXPECT_THAT(results(),
              ElementsAre(AllOf(is(CheckStatus::bad), finds("ModemManager"), finds("512"), finds("/" + link))));
}

TEST_F(DoctorDevicesTest, APortThatIsNotThereIsNamedWithThoseThatAre) {
  kiosk("cyberglove:sensors=18");
  EXPECT_THAT(results(), ElementsAre(AllOf(is(CheckStatus::bad), finds("/dev/ttyUSB0"), advises("cable"))));
  node("dev/ttyACM4", 0660);
  node("dev/ttyS0", 0660);
  EXPECT_THAT(results(), ElementsAre(AllOf(is(CheckStatus::bad), finds("/dev/ttyACM4"), Not(finds("ttyS0")),
                                           advises("/etc/mechane/haptic-kiosk-1"))));
  kiosk("cyberglove:port=/dev/ttyS0");
  write("etc/group", fmt::format("tty:x:{}:\ndialout:x:{}:\nmechane-devices:x:{}:", ours_, ours_ + 1, ours_ + 2));
  EXPECT_THAT(results(), ElementsAre(AllOf(is(CheckStatus::bad), finds("/dev/ttyS0"), finds("mechane-haptic@kiosk-1"),
                                           advises("dialout"))));
}

TEST_F(DoctorDevicesTest, HaplysServiceMustRun) {
  kiosk("haply");
  write("proc/net/tcp", "  sl  local_address rem_address   st\n   0: 0100007F:2711 0100007F:9C40 01 0:0");
  EXPECT_THAT(results(), ElementsAre(AllOf(is(CheckStatus::bad), finds("10001"), advises("haply-inverse-service"))));
  write("proc/net/tcp", "  sl  local_address rem_address   st\n   0: 0100007F:2711 00000000:0000 0A 0:0");
  EXPECT_THAT(results(), ElementsAre(is(CheckStatus::ok)));
  kiosk("haply:port=10002");
  EXPECT_THAT(results(), ElementsAre(AllOf(is(CheckStatus::bad), finds("10002"))));
  kiosk("haply:host=10.0.0.7,port=10002");
  EXPECT_THAT(results(), ElementsAre(is(CheckStatus::ok)));
}

TEST_F(DoctorDevicesTest, TwoDevicesOfAKioskHaveAHandEach) {
  kiosk("virtual");
  for (const char* options : {"--user 1 --center 0 0 0", "--center 0 0 0 --user=3", "--user 2"}) {
    second("virtual", fmt::format("KIOSK=kiosk-1\nOPTIONS={}", options));
    EXPECT_THAT(results(),
                ElementsAre(is(CheckStatus::ok), AllOf(is(CheckStatus::ok), is_about("device of kiosk-1-left"))));
  }
  second("virtual", "KIOSK=kiosk-1");
  EXPECT_THAT(results(),
              ElementsAre(is(CheckStatus::ok),
                          AllOf(is(CheckStatus::bad), is_about("device of kiosk-1-left"), finds("hand 0 of kiosk-1"),
                                finds("/etc/mechane/haptic-kiosk-1 "), advises("--user 1"))));
  second("virtual", "");
  EXPECT_THAT(results(), Each(is(CheckStatus::ok))) << "a kiosk of its own";
}

TEST_F(DoctorDevicesTest, WhatTheProgramDoesNotTakeOfAUnitsFileIsNamed) {
  const auto second_is = [&](const std::string& device, const std::string& more, const auto& matcher) {
    second(device, more);
    EXPECT_THAT(results(), ElementsAre(AllOf(is_about("device of kiosk-1-left"), matcher))) << device << "; " << more;
  };
  const auto refused = [](const std::string& part) {
    return AllOf(is(CheckStatus::bad), finds(part), advises("/etc/mechane/haptic-kiosk-1-left"));
  };
  second_is("virtual:kind=glove,hand=left", "OPTIONS=--calibrate --turn 90 --center -0.2 0.9 0.3 --deadband=0.1",
            AllOf(is(CheckStatus::ok), finds("hand 0 of kiosk-1-left")));
  second_is("virtual", "KIOSK=kiosk-1\nOPTIONS=--user 3", AllOf(is(CheckStatus::ok), finds("hand 3 of kiosk-1")));
  second_is("virtual:kind=foo", "", refused("foo"));
  second_is("virtual:kind=glove,delay=1", "", refused("delay"));
  second_is("virtual", "OPTIONS=--centre 0 0.9 0.3", refused("--centre"));
  second_is("virtual", "OPTIONS=--center 0 0.9", refused("--center"));
  second_is("virtual", "OPTIONS=--user 4", refused("--user"));
  second_is("virtual", "KIOSK=kiosk 1", refused("kiosk 1"));
  second_is("virtual", "KIOSK=", refused("kiosk"));
  haptic_ = scratch_.script("mechane-haptic", "kill -SEGV $$");
  second_is("virtual", "", AllOf(is(CheckStatus::bad), finds("mechane-haptic"), advises("install")));
  haptic_ = root_ / "none";
  second_is("virtual", "", AllOf(is(CheckStatus::bad), finds("none"), advises("install")));
}

TEST(DoctorDevices, CountsTheDevicesThatWillNotStart) {
  const auto result = [](const char* name, CheckStatus status) { return CheckResult{name, status, "", "", ""}; };
  const CheckResult good = result("device of a", CheckStatus::ok), odd = result("driver falcon", CheckStatus::warning);
  const CheckResult bad = result("device of b", CheckStatus::bad), worse = result("device of c", CheckStatus::bad);
  const CheckResult right = result("Novint Falcon", CheckStatus::bad);
  EXPECT_EQ(verdict_on({}), "");
  EXPECT_EQ(verdict_on({good, odd}), "");
  EXPECT_THAT(verdict_on({good, bad, odd, bad}), HasSubstr("1 haptic device will not start"));
  EXPECT_THAT(verdict_on({bad, right}), HasSubstr("1 haptic device will"));
  EXPECT_THAT(verdict_on({good, right}), HasSubstr("1 haptic device will"));
  EXPECT_THAT(verdict_on({bad, worse}), HasSubstr("2 haptic devices will"));
}

TEST_F(DoctorDevicesTest, ADeviceHasOneOwner) {
  groups("dialout", "mechane-devices");
  fs::create_directories(root_ / "dev/serial/by-id");
  fs::create_symlink("../../ttyUSB0", root_ / "dev/serial/by-id/usb-glove");
  node("dev/ttyUSB0", 0660);
  node("dev/ttyUSB1", 0660);
  kiosk("lucidgloves");
  second("lucidgloves:port=/dev/serial/by-id/usb-glove", "KIOSK=kiosk-1\nOPTIONS=--user 1");
  EXPECT_THAT(results(), ElementsAre(is(CheckStatus::ok), AllOf(is(CheckStatus::bad), finds("one and the same"),
                                                                finds("/dev/ttyUSB0"), advises("lucidgloves:port="))));
  second("lucidgloves:port=/dev/ttyUSB1", "KIOSK=kiosk-1\nOPTIONS=--user 1");
  EXPECT_THAT(results(), Each(is(CheckStatus::ok)));
}

TEST_F(DoctorDevicesTest, OfTwoDevicesEachIsPluggedIn) {
  plug_in("1451", "0402");
  node("dev/bus/usb/001/004", 0660);
  kiosk("dhd:library=libc.so.6");
  second("dhd:library=libc.so.6,device=1", "KIOSK=kiosk-1\nOPTIONS=--user 1");
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::bad), is_about("device of kiosk-1-left"), finds("device 2"),
                                        advises("cable"))));
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::ok), is_about("device of kiosk-1"))));
  second("dhd:library=libc.so.6,device=0", "KIOSK=kiosk-1\nOPTIONS=--user 1");
  EXPECT_THAT(results(), Contains(AllOf(is(CheckStatus::bad), finds("one and the same"), advises("dhd:device="))));
}

TEST_F(DoctorDevicesTest, AnAdapterMayBeAGloveOrAnotherProgramsBusiness) {
  plug_in("1a86", "7523");
  EXPECT_THAT(results(), ElementsAre(AllOf(is(CheckStatus::warning), finds("1a86:7523"), advises("journalctl"))));
  plug_in("1a86", "7523", "ttyUSB0/tty/ttyUSB0");
  groups("dialout", "mechane-devices");
  node("dev/ttyUSB0", 0660);
  EXPECT_THAT(results(),
              ElementsAre(AllOf(is(CheckStatus::warning), finds("/dev/ttyUSB0"), advises("usermod -aG dialout ada"))));
  open_in("9", "scanner", "/dev/ttyUSB0");
  EXPECT_THAT(results(), ElementsAre(AllOf(is(CheckStatus::ok), finds("scanner"))));
}

std::string text_of(const char* file) {
  std::ifstream in(test::source_folder() / file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(DoctorDevices, KnowsTheDevicesOfTheUdevRulesAndTheGroupsOfTheUnit) {
  const std::string rules = text_of("deploy/systemd/90-mechane-devices.rules");
  std::set<std::string> of_rules;
  const std::regex numbers(R"re(\{idVendor\}=="(\w+)"(?:.*\{idProduct\}=="(\w+)")?)re");
  for (std::sregex_iterator it(rules.begin(), rules.end(), numbers), end; it != end; ++it) {
    const std::string vendor = (*it)[1];
    const std::string product = (*it)[2];
    of_rules.insert(vendor);
    EXPECT_THAT(known_usb_devices(), Contains(testing::Truly([&](const KnownUsbDevice& known) {
                  return known.vendor == vendor && (known.product.empty() || known.product == product);
                })))
        << vendor << ":" << product;
  }
  for (const KnownUsbDevice& known : known_usb_devices())
    EXPECT_EQ(of_rules.contains(std::string(known.vendor)), !known.is_adapter) << known.name;
  EXPECT_THAT(rules, HasSubstr("GROUP=\"mechane-devices\""));
  EXPECT_THAT(text_of("deploy/systemd/mechane-haptic@.service"),
              AllOf(HasSubstr("SupplementaryGroups=dialout mechane-devices\n"),
                    HasSubstr("Environment=KIOSK=%i\nEnvironmentFile=/etc/mechane/haptic-%i\n"),
                    HasSubstr("--kiosk ${KIOSK} --device ${DEVICE} $OPTIONS\n")));
}

}  // namespace
}  // namespace mechane::cli
