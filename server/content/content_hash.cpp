#include "server/content/content_hash.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <xxhash.h>

#include "server/base/assert.hpp"

namespace mechane::content {
namespace {

std::string hex(const XXH128_hash_t& hash) {
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace

Expected<std::string> content_hash(const std::filesystem::path& file) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code)) {
    if (!code) {
      return fail(ErrorCode::invalid_value, "this is a folder or a device, not a file", file.string(), "name a file");
    }
    const bool absent = code == std::errc::no_such_file_or_directory || code == std::errc::not_a_directory;
    return fail(absent ? ErrorCode::not_found : ErrorCode::io_failure, code.message(), file.string(), "check the path");
  }
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    return fail(ErrorCode::io_failure, fmt::format("cannot be opened: {}", std::strerror(errno)), file.string(),
                "check the path and its rights");
  }
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  MECHANE_ASSERT(state != nullptr);
  XXH3_128bits_reset(state.get());
  std::vector<char> piece(1U << 16U);
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0) {
    XXH3_128bits_update(state.get(), piece.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) {
    return fail(ErrorCode::io_failure, "reading the file failed half way through", file.string(), "check the disk");
  }
  return hex(XXH3_128bits_digest(state.get()));
}

std::string content_hash(std::span<const std::byte> bytes) {
  return hex(XXH3_128bits(bytes.data(), bytes.size()));
}

}  // namespace mechane::content
