// A driver as a C++ class, and the C table that Mechane calls it by.
#pragma once

#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "client-sdk/drivers/options.hpp"
#include <mechane/driver.h>

namespace mechane::drivers {

/// What happened and what to do about it, in one line; empty: nothing.
using Fault = std::string;

/// Copies a fault to where C wants it, cut at `size`. Returns 0 without a fault, else 1.
inline int report(const Fault& fault, char* why, std::size_t size) noexcept {
  if (fault.empty()) return 0;
  std::snprintf(why, size, "%s", fault.c_str());
  return 1;
}

/// Nothing may be thrown out of a driver.
template <class Function>
int guarded(Function&& function, char* why, std::size_t size) noexcept {
  try {
    return report(function(), why, size);
  } catch (const std::exception& e) {
    return report(std::string("the driver failed: ") + e.what(), why, size);
  }
}

/// The table of class D, which has:
///   static constexpr const char *kSummary, *kOptions;      // see mechane_driver_table
///   Fault open(const Options&); Fault describe(mechane_device_info&);
///   Fault read(mechane_device_state&); Fault write(const mechane_device_force&);
/// and lets the device go in its destructor. read() and write() get structures that are all zeros but for a unit
/// orientation and an unknown temperature.
template <class D>
const mechane_driver_table& table_of() noexcept {
  static constexpr mechane_driver_table table = {
      .version = MECHANE_DRIVER_VERSION,
      .summary = D::kSummary,
      .options = D::kOptions,
      .open =
          [](const char* text, void** out, char* why, std::size_t size) {
            return guarded(
                [&]() -> Fault {
                  Options options(text, D::kOptions);
                  if (!options.fault().empty()) return options.fault();
                  auto device = std::make_unique<D>();
                  if (Fault fault = device->open(options); !fault.empty()) return fault;
                  if (!options.fault().empty()) return options.fault();
                  *out = device.release();
                  return {};
                },
                why, size);
          },
      .describe =
          [](void* device, mechane_device_info* info, char* why, std::size_t size) {
            *info = {};
            return guarded([&] { return static_cast<D*>(device)->describe(*info); }, why, size);
          },
      .read =
          [](void* device, mechane_device_state* state, char* why, std::size_t size) {
            *state = {};
            state->orientation_wxyz[0] = 1;
            state->temperature = -1;
            return guarded([&] { return static_cast<D*>(device)->read(*state); }, why, size);
          },
      .write =
          [](void* device, const mechane_device_force* force, char* why, std::size_t size) {
            return guarded([&] { return static_cast<D*>(device)->write(*force); }, why, size);
          },
      .close = [](void* device) { delete static_cast<D*>(device); },
  };
  return table;
}

}  // namespace mechane::drivers

/// In the one source file of a driver: exports class D.
#define MECHANE_EXPORT_DRIVER(D)                                                             \
  const mechane_driver_table* mechane_driver(uint32_t version) {                             \
    return version == MECHANE_DRIVER_VERSION ? &::mechane::drivers::table_of<D>() : nullptr; \
  }
