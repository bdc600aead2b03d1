#include "client-sdk/haptic/driver_link.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <new>
#include <numeric>
#include <utility>

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "server/hand/hand_skeleton.hpp"

namespace mechane::haptic {
namespace {

tl::unexpected<Error> no_link(const char* what) {
  return fail(ErrorCode::io_failure, std::string(what) + ": " + std::strerror(errno), "link to a driver's process");
}

DriverLink* map(int file) {
  void* const memory = ::mmap(nullptr, sizeof(DriverLink), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  return memory == MAP_FAILED ? nullptr : static_cast<DriverLink*>(memory);
}

}  // namespace

hand::HandBuild build_of(hand::HandSide side, const mechane_device_state& state, double hand_scale) noexcept {
  const hand::FingerSizes model = hand::middle_sized_fingers();
  const double palm_m = (model[1].X_HF.p + model[4].X_HF.p).norm() / 2;
  hand::HandBuild build;
  build.side = side;
  build.hand_scale =
      std::clamp(state.palm_m > 0 ? state.palm_m / palm_m : hand_scale, hand::kMinHandScale, hand::kMaxHandScale);
  for (std::size_t f = 0; f < hand::kFingers; ++f) {
    if (state.finger_m[f] == 0) continue;
    const double finger_m = std::accumulate(model[f].length_m.begin(), model[f].length_m.end(), 0.0);
    build.finger_scale[f] =
        std::clamp(state.finger_m[f] / (build.hand_scale * finger_m), hand::kMinFingerScale, hand::kMaxFingerScale);
  }
  return build;
}

bool wait_for(sem_t& semaphore, TimePoint until) noexcept {
  const auto ns = to_ns(until);
  const timespec deadline{static_cast<std::time_t>(ns / 1'000'000'000), static_cast<long>(ns % 1'000'000'000)};
  int result = 0;
  do {
    result = ::sem_clockwait(&semaphore, CLOCK_MONOTONIC, &deadline);
  } while (result != 0 && errno == EINTR);
  while (result == 0 && ::sem_trywait(&semaphore) == 0) {
  }
  return result == 0;
}

Expected<SharedLink> SharedLink::make() {
  const int file = ::memfd_create("mechane-driver", MFD_CLOEXEC);
  if (file < 0) return no_link("no memory to share");
  DriverLink* const link = ::ftruncate(file, sizeof(DriverLink)) == 0 ? map(file) : nullptr;
  if (link == nullptr) {
    const auto error = no_link("no memory to share");
    ::close(file);
    return error;
  }
  new (link) DriverLink;
  ::sem_init(&link->state_came, 1, 0);
  ::sem_init(&link->force_came, 1, 0);
  return SharedLink(file, link);
}

Expected<SharedLink> SharedLink::attach(int file) {
  struct stat status {};
  if (::fstat(file, &status) != 0) return no_link("it was not given");
  constexpr const char* kStranger = "it was made by another version";
  if (status.st_size != sizeof(DriverLink))
    return fail(ErrorCode::wrong_version, kStranger, "link to a driver's process");
  DriverLink* const link = map(file);
  if (link == nullptr) return no_link("it cannot be mapped");
  SharedLink shared(file, link);
  if (link->size != sizeof(DriverLink)) return fail(ErrorCode::wrong_version, kStranger, "link to a driver's process");
  return shared;
}

SharedLink::SharedLink(SharedLink&& other) noexcept
    : file_(std::exchange(other.file_, -1)), link_(std::exchange(other.link_, nullptr)) {}

SharedLink::~SharedLink() {
  if (link_ != nullptr) ::munmap(link_, sizeof(DriverLink));
  if (file_ >= 0) ::close(file_);
}

}  // namespace mechane::haptic
