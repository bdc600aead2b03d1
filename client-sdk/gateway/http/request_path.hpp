// Decoders of what a browser asks for: the target of a request, a Range header, a list of ETags.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "server/base/error.hpp"

namespace mechane::gateway {

struct RequestTarget {
  std::string path;  ///< decoded; begins with '/'; well-formed UTF-8 without control characters
  std::map<std::string, std::string> query;
};
/// Errors: invalid_value: not a path, a wrong escape, bytes that are not text.
[[nodiscard]] Expected<RequestTarget> parse_target(std::string_view target);

/// A part of a file: the bytes [from, from + size).
struct ByteRange {
  std::size_t from = 0;
  std::size_t size = 0;
};
/// Of "bytes=0-99", "bytes=100-", "bytes=-100" for a file of `whole` bytes (RFC 9110, 14.1.2). None: the header asks for several parts or
/// is not understood, so that the whole file is the answer. Errors: too_large, where no byte of it exists.
[[nodiscard]] Expected<std::optional<ByteRange>> parse_range(std::string_view header, std::size_t whole);

/// The next part of a list, without the blanks around it; `rest` begins after the separator.
[[nodiscard]] std::string_view next_part(std::string_view& rest, char separator);

/// Whether an If-None-Match header names this tag (with its quotes), or any.
[[nodiscard]] bool names_tag(std::string_view header, std::string_view tag);

/// The content type by a file's suffix; none: this suffix is not served.
[[nodiscard]] std::optional<std::string_view> content_type_of(const std::filesystem::path& file);

/// A file inside a folder, by a path with '/' that somebody else gave: no '..', no empty or hidden part, no backslash, and no symbolic
/// link out of the folder. Reads the disk. `hidden`: parts may begin with a dot. Errors: not_found; invalid_value for a path that tries to
/// leave the folder.
[[nodiscard]] Expected<std::filesystem::path> file_within(const std::filesystem::path& folder, std::string_view path,
                                                          bool hidden = false);

}  // namespace mechane::gateway
