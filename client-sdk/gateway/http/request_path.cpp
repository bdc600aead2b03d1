#include "client-sdk/gateway/http/request_path.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "server/base/utf8.hpp"

namespace mechane::gateway {
namespace {

std::optional<unsigned> hex_digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a') + 10;
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A') + 10;
  return std::nullopt;
}

std::optional<std::string> decoded(std::string_view text, bool plus_is_space) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += plus_is_space && text[i] == '+' ? ' ' : text[i];
      continue;
    }
    if (i + 2 >= text.size()) return std::nullopt;
    const auto high = hex_digit(text[i + 1]), low = hex_digit(text[i + 2]);
    if (!high || !low) return std::nullopt;
    out += static_cast<char>(*high * 16 + *low);
    i += 2;
  }
  if (first_bad_utf8(out) || std::ranges::any_of(out, [](char c) { return is_control(c); })) return std::nullopt;
  return out;
}

std::optional<std::size_t> number_of(std::string_view digits) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
    text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
    text.remove_suffix(1);
  return text;
}

tl::unexpected<Error> bad_target() {
  return fail(ErrorCode::invalid_value, "the gateway has no such address", {}, "check the address");
}

}  // namespace

Expected<RequestTarget> parse_target(std::string_view target) {
  if (target.empty() || target.front() != '/') return bad_target();
  const std::size_t mark = target.find('?');
  const auto path = decoded(target.substr(0, mark), false);
  if (!path) return bad_target();
  RequestTarget out{*path, {}};
  if (mark == std::string_view::npos) return out;
  std::string_view rest = target.substr(mark + 1);
  while (!rest.empty()) {
    const std::string_view pair = next_part(rest, '&');
    const std::size_t equals = std::min(pair.find('='), pair.size());
    const auto name = decoded(pair.substr(0, equals), true);
    const auto value = decoded(pair.substr(std::min(equals + 1, pair.size())), true);
    if (!name || !value) return bad_target();
    if (!name->empty()) out.query.try_emplace(*name, *value);
  }
  return out;
}

Expected<std::optional<ByteRange>> parse_range(std::string_view header, std::size_t whole) {
  constexpr std::string_view kUnit = "bytes=";
  if (!header.starts_with(kUnit)) return std::nullopt;
  const std::string_view range = trimmed(header.substr(kUnit.size()));
  const std::size_t dash = range.find('-');
  if (dash == std::string_view::npos || range.find(',') != std::string_view::npos) return std::nullopt;
  const auto first = number_of(trimmed(range.substr(0, dash)));
  const auto last = number_of(trimmed(range.substr(dash + 1)));
  const bool open_start = trimmed(range.substr(0, dash)).empty();
  const bool open_end = trimmed(range.substr(dash + 1)).empty();
  if ((!first && !open_start) || (!last && !open_end) || (open_start && open_end)) return std::nullopt;
  if (!open_start && !open_end && *last < *first) return std::nullopt;
  const auto nothing = [whole] {
    return fail(ErrorCode::too_large, "the file has no such part: it has " + std::to_string(whole) + " bytes", "Range",
                "ask for a part of the file");
  };
  if (open_start) {
    const std::size_t size = std::min(*last, whole);
    if (size == 0) return nothing();
    return ByteRange{whole - size, size};
  }
  if (*first >= whole) return nothing();
  const std::size_t end = open_end ? whole : std::min(*last, whole - 1) + 1;
  return ByteRange{*first, end - *first};
}

std::string_view next_part(std::string_view& rest, char separator) {
  const std::size_t end = rest.find(separator);
  const std::string_view part = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  return trimmed(part);
}

bool names_tag(std::string_view header, std::string_view tag) {
  while (!header.empty()) {
    std::string_view one = next_part(header, ',');
    if (one.starts_with("W/")) one.remove_prefix(2);
    if (one == "*" || one == tag) return true;
  }
  return false;
}

std::optional<std::string_view> content_type_of(const std::filesystem::path& file) {
  using Known = std::pair<std::string_view, std::string_view>;
  static constexpr std::array<Known, 25> kKnown{{
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".mjs", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json"},
      {".webmanifest", "application/manifest+json"},
      {".wasm", "application/wasm"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"},
      {".jpeg", "image/jpeg"},
      {".webp", "image/webp"},
      {".ico", "image/x-icon"},
      {".woff2", "font/woff2"},
      {".glb", "model/gltf-binary"},
      {".gltf", "model/gltf+json"},
      {".obj", "model/obj"},
      {".stl", "model/stl"},
      {".wav", "audio/wav"},
      {".ogg", "audio/ogg"},
      {".oga", "audio/ogg"},
      {".mp3", "audio/mpeg"},
      {".flac", "audio/flac"},
      {".hdr", "image/vnd.radiance"},
      {".task", "application/octet-stream"},
  }};
  const std::string suffix = lower_case(file.extension().string());
  const auto found = std::ranges::find(kKnown, suffix, &Known::first);
  if (found == kKnown.end()) return std::nullopt;
  return found->second;
}

Expected<std::filesystem::path> file_within(const std::filesystem::path& folder, std::string_view path, bool hidden) {
  const auto leaves = [path] {
    return fail(ErrorCode::invalid_value, "this path leads out of its folder", std::string(path),
                "ask for a file of the folder, without '..' and hidden names");
  };
  std::filesystem::path file = folder;
  for (std::size_t from = 0; from <= path.size();) {
    const std::size_t end = std::min(path.find('/', from), path.size());
    const std::string_view name = path.substr(from, end - from);
    const bool dots = hidden ? name == "." || name == ".." : name.starts_with('.');
    if (name.empty() || dots || name.find('\\') != std::string_view::npos || name.size() > 255) return leaves();
    file /= name;
    from = end + 1;
  }
  std::error_code error;
  const std::filesystem::path real_folder = std::filesystem::canonical(folder, error);
  const std::filesystem::path real = error ? std::filesystem::path() : std::filesystem::canonical(file, error);
  if (error || !std::filesystem::is_regular_file(real, error))
    return fail(ErrorCode::not_found, "there is no such file", std::string(path), "check its name");
  const auto [in_folder, in_file] = std::ranges::mismatch(real_folder, real);
  if (in_folder != real_folder.end()) return leaves();
  return real;
}

}  // namespace mechane::gateway
