#include "server/transport/exhibit_gate.hpp"

#include <algorithm>
#include <utility>

#include <mechane/proto/names.hpp>

namespace mechane::transport {

static_assert(mechane_exhibit_load == static_cast<int>(ExhibitVerb::load));
static_assert(mechane_exhibit_replace == static_cast<int>(ExhibitVerb::replace));
static_assert(mechane_exhibit_retire == static_cast<int>(ExhibitVerb::retire));

std::string_view words_of(ExhibitFault fault) {
  switch (fault) {
    case ExhibitFault::none:
      return "it is taken";
    case ExhibitFault::not_for_us:
      return "it is for another server, or for a former run of this one";
    case ExhibitFault::no_key:
      return "this server takes no requests about exhibits: it has no key";
    case ExhibitFault::forged:
      return "it was sealed with a different key";
    case ExhibitFault::late:
      return "another request came first";
    case ExhibitFault::replayed:
      return "it was taken before";
    case ExhibitFault::bad_value:
      return "unknown verb, or a name that an exhibit cannot have";
  }
  return "";
}

ExhibitGate::ExhibitGate(std::optional<proto::ExhibitKey> key, std::string server, std::uint64_t incarnation)
    : key_(key), server_(std::move(server)), incarnation_(incarnation) {}

std::array<std::uint8_t, 16> ExhibitGate::key_mark() const {
  return key_ ? key_->mark() : std::array<std::uint8_t, 16>{};
}

ExhibitFault ExhibitGate::take(const proto::ExhibitRequest& wire, ExhibitOrder& order) {
  if (wire.protocol != proto::kProtocol || proto::text_of(wire.server) != server_) return ExhibitFault::not_for_us;
  if (!key_) return ExhibitFault::no_key;
  if (!key_->fits(wire)) return ExhibitFault::forged;
  // From here on it was sealed by somebody with the key; when, and how often it was sent since, is still open.
  if (wire.incarnation != incarnation_) return ExhibitFault::not_for_us;
  if (std::ranges::find(taken_, wire.id) != taken_.end()) return ExhibitFault::replayed;  // an id is never 0
  order.id = wire.id;
  if (wire.counter <= counter_) return ExhibitFault::late;
  if (wire.verb > mechane_exhibit_retire || !proto::is_exhibit_name(proto::text_of(wire.exhibit)))
    return ExhibitFault::bad_value;
  counter_ = wire.counter;
  taken_[next_taken_++ % taken_.size()] = wire.id;
  order.verb = static_cast<ExhibitVerb>(wire.verb);
  order.exhibit = proto::text_of(wire.exhibit);
  order.now = wire.now;
  return ExhibitFault::none;
}

}  // namespace mechane::transport
