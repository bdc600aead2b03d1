// What a finger's point feels of an object: the question that the server asks a thousand times a second, asked for one point.
#pragma once

#include <cstddef>

#include "server/base/math.hpp"
#include "server/collision/object.hpp"

namespace mechane::fit {

struct Felt {
  bool hit = false;  ///< without it the other fields mean nothing
  double depth_m = 0;
  std::size_t part = 0;
};

/// Asks find_contacts, whatever representation a part has. Copies the maps of the object; any thread may ask.
class Probe {
 public:
  explicit Probe(const collision::Object& object);

  /// One part alone, as if the others were not there. The answers call it part 0.
  Probe(const collision::Object& object, std::size_t part);

  [[nodiscard]] Felt at(const Vec3& p_OP) const;

 private:
  collision::Object object_;  // without samples: only its maps are asked
  collision::Object point_;   // one sample at its own origin
};

}  // namespace mechane::fit
