// The state is one inline struct of the hash library on the stack: hashing allocates nothing, so the loop may do it.
#define XXH_STATIC_LINKING_ONLY
#include <cstring>

#include <xxhash.h>

#include "server/base/assert.hpp"
#include "server/state/archive.hpp"

namespace mechane::state {
namespace {

/// Gathers fields in blocks, for speed.
class HashArchive {
 public:
  HashArchive() { XXH3_64bits_reset(&hash_); }

  template <class T>
  void bytes(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (used_ + sizeof(T) > sizeof(block_)) flush();
    std::memcpy(block_ + used_, &value, sizeof(T));
    used_ += sizeof(T);
  }
  [[nodiscard]] std::uint64_t digest() {
    flush();
    return XXH3_64bits_digest(&hash_);
  }

 private:
  void flush() {
    const XXH_errorcode code = XXH3_64bits_update(&hash_, block_, used_);
    MECHANE_ASSERT(code == XXH_OK);
    used_ = 0;
  }

  XXH3_state_t hash_{};
  unsigned char block_[1024]{};
  std::size_t used_ = 0;
};

}  // namespace

std::uint64_t state_hash(const WorldState& state, StateVersion version) noexcept {
  HashArchive archive;
  StateWalk<HashArchive, const WorldState>(archive, state, version).run();
  return archive.digest();
}

}  // namespace mechane::state
