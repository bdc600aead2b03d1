#include <algorithm>
#include <span>
#include <vector>

#include <fcntl.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include "server/base/byte_order.hpp"
#include "server/base/whole_file.hpp"
#include <mechane/proto/exhibit_key.hpp>
#include <mechane/proto/names.hpp>

namespace mechane::proto {
namespace {

constexpr std::size_t kKeyBytes = crypto_auth_KEYBYTES;
static_assert(kKeyBytes == 32 && crypto_auth_BYTES == 32);
constexpr std::size_t kMostKeyFile = 200;
constexpr std::size_t kMostExhibitName = 63;

std::vector<std::byte> sealed_bytes(const ExhibitRequest& request) {
  std::vector<std::byte> out;
  VectorSink sink(out);
  // Texts have their length before them, so that no two requests have the same bytes.
  put_string(sink, "mechane exhibit request 1");
  put_string(sink, text_of(request.server));
  for (const std::uint64_t number : {request.incarnation, request.counter, request.id, std::uint64_t{request.verb}})
    put(sink, number);
  put_string(sink, text_of(request.exhibit));
  put(sink, static_cast<std::uint8_t>(request.now ? 1 : 0));
  return out;
}

const unsigned char* of_sodium(const std::vector<std::byte>& bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

Expected<void> check_rights(const std::filesystem::path& file) {
  struct stat facts {};
  if (::stat(file.c_str(), &facts) != 0) return tl::unexpected(file_error("cannot be read", file, errno));
  if ((facts.st_mode & (S_IRWXG | S_IRWXO)) == 0) return {};
  return fail(ErrorCode::conflict, "others than its user may use this key", file.string(),
              "chmod 600 " + file.string() + "; if somebody may have read it, delete it and start the server again");
}

Expected<void> make(const std::filesystem::path& file) {
  std::error_code ignored;  // open() below tells what is wrong
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), ignored);
  std::array<std::uint8_t, kKeyBytes> raw;
  randombytes_buf(raw.data(), raw.size());
  std::string text(2 * kKeyBytes + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), raw.data(), raw.size());
  text.back() = '\n';
  // Whole or not at all: a server that is killed in between must not leave half a key.
  const std::filesystem::path draft = file.string() + ".new";
  ::unlink(draft.c_str());
  const int fd = ::open(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (fd < 0) return tl::unexpected(file_error("the key cannot be written", draft, errno));
  int error = write_all(fd, std::as_bytes(std::span(text)));
  ::close(fd);
  if (error == 0) error = flush_to_disk(draft);
  if (error == 0 && ::rename(draft.c_str(), file.c_str()) != 0) error = errno;
  if (error == 0) return {};
  ::unlink(draft.c_str());
  return tl::unexpected(file_error("the key cannot be written", file, error));
}

}  // namespace

bool is_exhibit_name(std::string_view name) {
  return !name.empty() && name.size() <= kMostExhibitName && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

Expected<ExhibitKey> ExhibitKey::read(const std::filesystem::path& file) {
  if (sodium_init() < 0)
    return fail(ErrorCode::failed_process, "libsodium has no random numbers on this machine", {}, "see its log");
  auto bytes = read_whole(file, kMostKeyFile);
  if (!bytes) return tl::unexpected(bytes.error());
  if (auto ok = check_rights(file); !ok) return tl::unexpected(ok.error());
  std::string text(as_text(*bytes));
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  ExhibitKey key;
  std::size_t size = 0;
  const char* end = nullptr;
  const int bad = sodium_hex2bin(key.bytes_.data(), key.bytes_.size(), text.data(), text.size(), nullptr, &size, &end);
  if (bad != 0 || size != kKeyBytes || end != text.data() + text.size()) {
    return fail(ErrorCode::damaged, "this is not a key of 64 hex digits", file.string(),
                "copy the server's key file anew, or delete it and start the server again");
  }
  return key;
}

Expected<ExhibitKey> ExhibitKey::read_or_make(const std::filesystem::path& file) {
  std::error_code code;
  if (!std::filesystem::exists(file, code)) {
    if (sodium_init() < 0)
      return fail(ErrorCode::failed_process, "libsodium has no random numbers on this machine", {}, "see its log");
    if (auto made = make(file); !made) return tl::unexpected(made.error());
  }
  return read(file);
}

std::array<std::uint8_t, 16> ExhibitKey::mark() const {
  std::array<std::uint8_t, 16> mark{};
  constexpr std::string_view kWhat = "mechane exhibit key";
  crypto_generichash(mark.data(), mark.size(), reinterpret_cast<const std::uint8_t*>(kWhat.data()), kWhat.size(),
                     bytes_.data(), bytes_.size());
  return mark;
}

void ExhibitKey::seal(ExhibitRequest& request) const {
  const auto bytes = sealed_bytes(request);
  crypto_auth(request.seal, of_sodium(bytes), bytes.size(), bytes_.data());
}

bool ExhibitKey::fits(const ExhibitRequest& request) const {
  const auto bytes = sealed_bytes(request);
  return crypto_auth_verify(request.seal, of_sodium(bytes), bytes.size(), bytes_.data()) == 0;
}

}  // namespace mechane::proto
