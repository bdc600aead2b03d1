// Any bytes as a part file: an Error, or an object that can be queried without a fault. The checksum would stop nearly every input, so the
// bytes are tried as they are, and with a right checksum.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "server/collision/object.hpp"
#include "server/collision/object_io.hpp"

namespace {

void try_bytes(std::span<const std::byte> bytes) {
  const auto object = mechane::collision::read_object(bytes);
  if (!object) return;
  std::array<mechane::collision::PointContact, 16> storage;
  mechane::collision::ContactBuffer buffer(storage);
  mechane::collision::find_contacts(*object, {}, *object, {mechane::Vec3(0.001, 0, 0), mechane::Quat::Identity()},
                                    buffer);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::byte> bytes(size);
  if (size > 0) std::memcpy(bytes.data(), data, size);
  try_bytes(bytes);
  mechane::collision::reseal(bytes);
  try_bytes(bytes);
  return 0;
}
