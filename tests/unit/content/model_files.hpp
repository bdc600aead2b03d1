// Small model files that the tests of this folder write for themselves.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/scratch_folder.hpp"

namespace mechane::content {

using test::ScratchFolder;

/// A cube of 2 m around the origin; its faces look outwards.
inline constexpr float kCube[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                      {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
inline constexpr std::uint16_t kCubeFaces[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                                    {3, 7, 6}, {3, 6, 2}, {0, 4, 7}, {0, 7, 3}, {1, 2, 6}, {1, 6, 5}};

inline std::string cube_obj() {
  std::string text;
  for (const auto& v : kCube)
    text += "v " + std::to_string(v[0]) + " " + std::to_string(v[1]) + " " + std::to_string(v[2]) + "\n";
  for (const auto& f : kCubeFaces) {
    text += "f " + std::to_string(f[0] + 1) + " " + std::to_string(f[1] + 1) + " " + std::to_string(f[2] + 1) + "\n";
  }
  return text;
}

inline std::string cube_ply() {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 12\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& v : kCube)
    text += std::to_string(v[0]) + " " + std::to_string(v[1]) + " " + std::to_string(v[2]) + "\n";
  for (const auto& f : kCubeFaces)
    text += "3 " + std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) + "\n";
  return text;
}

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Binary STL: every triangle with vertices of its own.
inline std::string cube_stl() {
  std::string bytes(80, ' ');
  append(bytes, std::uint32_t{12});
  for (const auto& face : kCubeFaces) {
    for (int i = 0; i < 3; ++i)
      append(bytes, 0.0F);
    for (const std::uint16_t v : face)
      bytes.append(reinterpret_cast<const char*>(kCube[v]), 12);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

/// Glues a glb together: the JSON and one binary buffer.
inline std::string glb(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  append(bytes, std::uint32_t{2});
  append(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary.size()));
  append(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  append(bytes, static_cast<std::uint32_t>(binary.size()));
  bytes += std::string("BIN\0", 4) + binary;
  return bytes;
}

/// Begins like a PNG; nothing here decodes it.
inline const std::string kPng = "\x89PNG\r\n\x1a\n not decoded by the import";

/// A cube under nodes BODY (shifted by 1 m along x) > part_block and BODY > trimming (the same mesh, shrunk and mirrored), with a
/// material and an image. `vertex` stands for the buffer's first coordinate, to plant a fault; `looks` are more fields of the material.
inline std::string cube_glb(float vertex = -1, const std::string& looks = "") {
  std::string binary(reinterpret_cast<const char*>(kCube), sizeof kCube);
  std::memcpy(binary.data(), &vertex, sizeof vertex);
  binary.append(reinterpret_cast<const char*>(kCubeFaces), sizeof kCubeFaces);
  const std::size_t image = binary.size();
  binary += kPng;
  const std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[
{"name":"BODY","translation":[1,0,0],"children":[1,2]},{"name":"part_block","mesh":0},
{"name":"trimming","mesh":0,"scale":[-0.5,0.5,0.5]}],
"meshes":[{"name":"cube","primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
"materials":[{)" +
      looks +
      R"("name":"bronze","doubleSided":true,"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[0.8,0.5,0.2,0.9],
"metallicFactor":0.75,"roughnessFactor":0.25,"baseColorTexture":{"index":0}}}],
"textures":[{"source":0}],"images":[{"name":"patina","mimeType":"image/png","bufferView":2}],
"accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[-1,-1,-1],"max":[1,1,1]},
{"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":72},
{"buffer":0,"byteOffset":)" +
      std::to_string(image) + R"(,"byteLength":)" + std::to_string(kPng.size()) + R"(}],
"buffers":[{"byteLength":)" +
      std::to_string(binary.size()) + "}]}";
  return glb(json, binary);
}

}  // namespace mechane::content
