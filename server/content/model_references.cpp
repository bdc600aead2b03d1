#include "server/content/model_references.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "server/base/utf8.hpp"

namespace mechane::content {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// The JSON of a real model is far smaller; what is beyond this is not read.
constexpr std::uint32_t kMostJson_bytes = 64U << 20;

/// "%20" is a blank, as in any URI.
std::string without_percents(const std::string& uri) {
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                         std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
    path += escaped ? static_cast<char>(std::strtol(uri.substr(i + 1, 2).c_str(), nullptr, 16)) : uri[i];
    if (escaped) i += 2;
  }
  return path;
}

void add_path(const std::string& path, std::set<std::string>& found) {
  const bool scheme = path.find(':') != std::string::npos;  // "data:", "http:", "C:"
  if (path.empty() || scheme || path.front() == '/' || path.find('\0') != std::string::npos) return;
  found.insert(path);
}

/// The text of a .gltf, or of a .glb's first chunk. The file has `left` bytes.
std::string json_text(std::ifstream& in, std::uintmax_t left) {
  const std::uint32_t chunk = seek_glb_json(in).value_or(kMostJson_bytes);
  std::string text(std::min<std::uintmax_t>({left, chunk, kMostJson_bytes}), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

std::set<std::string> files_of_gltf(std::ifstream& in, std::uintmax_t bytes) {
  std::set<std::string> found;
  const Json json = Json::parse(json_text(in, bytes), nullptr, false);
  if (!json.is_object()) return found;
  for (const char* list : {"buffers", "images"}) {
    const auto items = json.find(list);
    if (items == json.end() || !items->is_array()) continue;
    for (const Json& item : *items) {
      if (!item.is_object()) continue;
      const auto uri = item.find("uri");
      if (uri != item.end() && uri->is_string()) add_path(without_percents(uri->get<std::string>()), found);
    }
  }
  return found;
}

/// A line's first word, and the rest without blanks around it.
std::pair<std::string, std::string> split(const std::string& line) {
  const char* blanks = " \t\r";
  const std::size_t word = line.find_first_not_of(blanks);
  if (word == std::string::npos) return {};
  const std::size_t end = std::min(line.find_first_of(blanks, word), line.size());
  const std::size_t rest = line.find_first_not_of(blanks, end);
  if (rest == std::string::npos) return {line.substr(word, end - word), ""};
  return {line.substr(word, end - word), line.substr(rest, line.find_last_not_of(blanks) - rest + 1)};
}

/// The file name after the options: "oak.png" of "-s 1 1 1 -clamp on oak.png".
std::string without_options(std::string text) {
  while (text.starts_with('-')) {
    const auto [option, rest] = split(text);
    text = rest;
    for (;;) {  // its values: numbers, or on and off
      const auto [value, behind] = split(text);
      char* end = nullptr;
      std::strtod(value.c_str(), &end);
      const bool number = !value.empty() && *end == '\0';
      if (behind.empty() || (!number && value != "on" && value != "off")) break;
      text = behind;
    }
  }
  return text;
}

void add_images(const fs::path& mtl, const fs::path& below, std::set<std::string>& found) {
  std::error_code code;
  if (!fs::is_regular_file(mtl, code)) return;
  std::ifstream in(mtl);
  for (std::string line; std::getline(in, line);) {
    const auto [word, rest] = split(line);
    const bool image = word.starts_with("map_") || word == "bump" || word == "disp" || word == "decal" ||
                       word == "refl" || word == "norm";
    const std::string name = without_options(rest);
    if (image && !name.empty()) add_path((below / name).generic_string(), found);
  }
}

std::set<std::string> files_of_obj(std::ifstream& in, const fs::path& folder) {
  std::set<std::string> found;
  for (std::string line; std::getline(in, line);) {
    const auto [word, rest] = split(line);
    if (word != "mtllib") continue;
    std::error_code code;
    std::set<std::string> libraries;
    if (fs::exists(folder / rest, code)) {
      add_path(rest, libraries);  // one with blanks in its name
    } else {
      std::istringstream names(rest);
      for (std::string name; names >> name;)
        add_path(name, libraries);
    }
    for (const std::string& library : libraries)
      add_images(folder / library, fs::path(library).parent_path(), found);
    found.merge(libraries);
  }
  return found;
}

}  // namespace

std::optional<std::uint32_t> seek_glb_json(std::istream& file) {
  std::array<char, 20> head{};  // "glTF", version, length; the chunk's length, "JSON"
  if (file.read(head.data(), head.size()) && std::memcmp(head.data(), "glTF", 4) == 0) {
    std::uint32_t bytes = 0;
    std::memcpy(&bytes, head.data() + 12, sizeof bytes);
    return bytes;
  }
  file.clear();
  file.seekg(0);
  return std::nullopt;
}

bool is_piece_of_model(const fs::path& file) {
  const std::string ending = lower_case(file.extension().string());
  return ending == ".bin" || ending == ".mtl";
}

Expected<std::set<std::string>> files_of_model(const fs::path& model) {
  const std::string ending = lower_case(model.extension().string());
  const bool obj = ending == ".obj";
  if (!obj && ending != ".gltf" && ending != ".glb") return std::set<std::string>{};
  std::ifstream in(model, std::ios::binary);
  if (!in) return fail(ErrorCode::io_failure, "the model cannot be read", model.string(), "check its path and rights");
  std::error_code code;
  const std::uintmax_t bytes = fs::file_size(model, code);
  if (code) return fail(ErrorCode::io_failure, code.message(), model.string(), "check the file");
  return obj ? files_of_obj(in, model.parent_path()) : files_of_gltf(in, bytes);
}

}  // namespace mechane::content
