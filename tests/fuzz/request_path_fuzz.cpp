// A request's target and its headers: no bytes lead out of a folder or beyond a file. The first line is the target, the second a Range, the
// third a list of tags, the fourth a Cookie, the fifth a file of accounts.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>

#include <unistd.h>

#include "client-sdk/gateway/http/request_path.hpp"
#include "client-sdk/gateway/http/security_headers.hpp"
#include "client-sdk/gateway/sign_in/accounts.hpp"
#include "client-sdk/gateway/sign_in/sessions.hpp"

namespace {

using namespace mechane::gateway;

void must_be(bool held) {
  if (!held) std::abort();
}

/// A folder with one file, beside a file that nobody may reach.
struct GuardedFolder {
  GuardedFolder() : path(std::filesystem::temp_directory_path() / ("mechane-path-fuzz-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path / "in/sub");
    std::ofstream(path / "in/sub/a.png") << "a";
    std::ofstream(path / "secret.png") << "secret";
    std::error_code exists;
    std::filesystem::create_directory_symlink(path, path / "in/up", exists);
    path = std::filesystem::canonical(path);
  }
  GuardedFolder(const GuardedFolder&) = delete;
  GuardedFolder& operator=(const GuardedFolder&) = delete;
  ~GuardedFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  std::filesystem::path path;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const GuardedFolder kFolder;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  std::array<std::string_view, 5> lines;
  for (std::string_view& line : lines) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (const auto target = parse_target(lines[0])) {
    must_be(target->path.front() == '/' && target->path.find('\0') == std::string::npos);
    const auto file = file_within(kFolder.path / "in", std::string_view(target->path).substr(1));
    must_be(!file || *file == kFolder.path / "in/sub/a.png");
  }
  for (const std::size_t whole : {std::size_t{0}, std::size_t{1}, std::size_t{1000}}) {
    const auto range = parse_range(lines[1], whole);
    must_be(!range || !*range || ((*range)->size > 0 && (*range)->from + (*range)->size <= whole));
  }
  (void)names_tag(lines[2], "\"tag\"");
  must_be(session_cookie(std::string(lines[3])).size() <= lines[3].size());
  (void)is_own_origin(lines[2], lines[3], true);
  if (const auto accounts = parse_accounts(lines[4])) must_be(accounts->size() <= Accounts::kMost);
  return 0;
}
