// Catalogues that the tests of this folder make.
#pragma once

#include <set>
#include <span>
#include <sstream>

#include <fmt/format.h>

#include "server/content/catalogue.hpp"
#include "server/content/content_hash.hpp"
#include "tests/unit/content/model_files.hpp"

namespace mechane::content {

/// An entry with only what follows from its path.
inline CatalogueEntry plain_entry(const std::string& path) {
  CatalogueEntry entry;
  entry.path = path;
  entry.kind = kind_of_file(path).value_or(ContentKind::model);
  entry.name = std::filesystem::path(path).stem().string();
  entry.hash = content_hash(std::as_bytes(std::span(path)));
  entry.bytes = path.size();
  return entry;
}

using test::folder_in_memory;

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

}  // namespace mechane::content
