// What a fingertip's point feels of an object: the server's contact query, for one point.
#pragma once

#include <cstddef>

#include "server/base/math.hpp"
#include "server/collision/object.hpp"

namespace mechane::fit {

struct Felt {
  bool hit = false;  ///< if false, the other fields mean nothing
  double depth_m = 0;
  std::size_t part = 0;
};

/// Calls find_contacts, for any representation of a part. Copies the maps of the object; any thread.
class Probe {
 public:
  explicit Probe(const collision::Object& object);

  /// One part alone, without the others. In the answers it is part 0.
  Probe(const collision::Object& object, std::size_t part);

  [[nodiscard]] Felt at(const Vec3& p_OP) const;

 private:
  collision::Object object_;  // without samples: only its maps are asked
  collision::Object point_;   // one sample at its own origin
};

}  // namespace mechane::fit
