// What operators send and what is stored of it, and what staff send about the pace of a trial and about haptic devices: whatever the
// bytes, they are read and written as the same again, or refused with a remedy.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "client-sdk/gateway/browsers/asked_devices.hpp"
#include "client-sdk/gateway/operations/operations.hpp"
#include "client-sdk/gateway/preview_api.hpp"

namespace {

using namespace mechane::gateway;

void must_hold(bool held) {
  if (!held) std::abort();
}

template <class T>
bool is_read(const mechane::Expected<T>& read) {
  if (!read) must_hold(!read.error().what.empty() && !read.error().remedy.empty());
  return read.has_value();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::int64_t kNow = 1'800'000'000;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto hours = parse_hours(text); is_read(hours)) {
    const auto again = parse_hours(hours_text(*hours));
    must_hold(again && *again == *hours);
    if (hours->museum)
      if (const auto change = next_change(*hours->museum, kNow))
        must_hold(is_open(*hours->museum, *change) != is_open(*hours->museum, kNow));
  }
  if (const auto state = parse_operations(text); is_read(state)) {
    const auto again = parse_operations(operations_text(*state));
    must_hold(again && *again == *state);
    must_hold(target_of(*state, "kiosk-1", kNow).message_en.size() <= 240);
  }
  if (const auto end = parse_end(text, kNow); is_read(end)) must_hold(!*end || **end > kNow);
  if (const auto message = parse_visitor_message(text, kNow); is_read(message)) must_hold(!message->texts.empty());
  if (const auto pace = parse_pace(std::string(text)); is_read(pace))
    must_hold(pace->pace >= 0 && pace->pace <= 1 && pace->ticks <= 10'000);
  if (const auto order = parse_device_order(std::string(text)); is_read(order))
    must_hold(mechane::client::check(*order).has_value());
  return 0;
}
