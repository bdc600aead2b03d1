// What browsers send: whatever its bytes, it is read with finite numbers and short texts, or refused with a remedy.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "client-sdk/gateway/browsers/browser_message.hpp"
#include "client-sdk/gateway/operations/visits_query.hpp"

namespace {

using namespace mechane::gateway;

void must_hold(bool held) {
  if (!held) std::abort();
}

void look_at(const PointerMessage& message) {
  must_hold(message.events.size() <= kMostEvents);
  must_hold(message.sight.view.P.allFinite() && message.sight.view.V_CW.allFinite());
  must_hold(message.sight.picture.width >= 2 && message.sight.picture.height >= 2);
  for (const PointerMessage::One& one : message.events) {
    must_hold(std::isfinite(one.event.x) && std::isfinite(one.event.y) && std::isfinite(one.event.amount));
    must_hold(!one.pick || one.pick->p_WT.allFinite());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (const auto remark = parse_remark({reinterpret_cast<const char*>(data), size}, "eleni"))
    must_hold(!remark->text.empty() && (!remark->at_s || std::isfinite(*remark->at_s)));
  const auto message = parse_browser_message({reinterpret_cast<const char*>(data), size});
  if (!message) {
    must_hold(!message.error().remedy.empty());
    return 0;
  }
  if (const auto* pointer = std::get_if<PointerMessage>(&*message)) look_at(*pointer);
  if (const auto* press = std::get_if<PressMessage>(&*message))
    must_hold(action_of(action_text(press->action)) == press->action);
  if (const auto* status = std::get_if<StatusMessage>(&*message)) must_hold(std::isfinite(status->pictures_per_s));
  return 0;
}
