#include "server/content/scene_codec.hpp"

#include <limits>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/error_like.hpp"

namespace mechane::content {
namespace {

using test::is_error;

/// A valid scene of any size.
rc::Gen<ImportedScene> any_scene() {
  return rc::gen::exec([] {
    ImportedScene scene;
    const auto number = [] { return static_cast<float>(*rc::gen::inRange(-1000, 1000)) / 8.0F; };
    const int meshes = *rc::gen::inRange(1, 4);
    for (int i = 0; i < *rc::gen::inRange(1, 3); ++i) {
      auto& t = scene.textures.emplace_back();
      t.name = *rc::gen::string<std::string>();
      for (const char c : *rc::gen::string<std::string>())
        t.bytes.push_back(static_cast<std::byte>(c));
    }
    auto& m = scene.materials.emplace_back();
    m.name = *rc::gen::string<std::string>();
    m.base_colour = {number(), number(), number(), number()};
    m.alpha_mode = *rc::gen::element(AlphaMode::opaque, AlphaMode::mask, AlphaMode::blend);
    m.double_sided = *rc::gen::arbitrary<bool>();
    if (*rc::gen::arbitrary<bool>()) m.normal_texture = 0;
    if (*rc::gen::arbitrary<bool>()) m.occlusion_texture = 0;
    m.occlusion_strength = number();
    for (int i = 0; i < meshes; ++i) {
      auto& mesh = scene.meshes.emplace_back();
      const int vertices = *rc::gen::inRange(3, 12);
      for (int v = 0; v < vertices; ++v) {
        mesh.positions.emplace_back(number(), number(), static_cast<float>(v));
        mesh.uv.emplace_back(number(), number());
        mesh.tangents.emplace_back(1.0F, 0.0F, number(), -1.0F);
      }
      mesh.indices = *rc::gen::container<std::vector<std::uint32_t>>(
          3, rc::gen::inRange(0U, static_cast<std::uint32_t>(vertices)));
    }
    for (int i = 0; i < meshes; ++i) {
      auto& node = scene.nodes.emplace_back();
      node.name = *rc::gen::string<std::string>();
      if (i > 0) node.parent = static_cast<std::uint32_t>(*rc::gen::inRange(0, i));
      node.X_PN.translation() = Vec3(number(), number(), number());
      node.meshes = {static_cast<std::uint32_t>(i)};
    }
    return scene;
  });
}

const ImportLimits kWide = [] {
  ImportLimits limits;
  limits.largest_m = 1e6;
  return limits;
}();

RC_GTEST_PROP(SceneCodec, CarriesASceneWhole, ()) {
  const ImportedScene scene = *any_scene();
  const std::vector<std::byte> message = encode_scene(scene);
  RC_ASSERT(message.size() <= longest_message(kWide));
  const auto back = decode_scene(message, kWide);
  RC_ASSERT(back.has_value());
  RC_ASSERT(encode_scene(*back) == message);
  RC_ASSERT(back->nodes.back().name == scene.nodes.back().name);
  RC_ASSERT(back->meshes.front().positions == scene.meshes.front().positions);
  RC_ASSERT(back->materials.front().normal_texture == scene.materials.front().normal_texture);
  RC_ASSERT(back->materials.front().occlusion_texture == scene.materials.front().occlusion_texture);
  RC_ASSERT(back->materials.front().occlusion_strength == scene.materials.front().occlusion_strength);
}

RC_GTEST_PROP(SceneCodec, RefusesAnyChangedByte, ()) {
  std::vector<std::byte> message = encode_scene(*any_scene());
  const auto at = *rc::gen::inRange<std::size_t>(0, message.size());
  message[at] ^= static_cast<std::byte>(*rc::gen::inRange(1, 256));
  const auto back = decode_scene(message, kWide);
  RC_ASSERT(!back.has_value());
}

RC_GTEST_PROP(SceneCodec, RefusesAnyShorterMessage, ()) {
  std::vector<std::byte> message = encode_scene(*any_scene());
  message.resize(*rc::gen::inRange<std::size_t>(0, message.size()));
  RC_ASSERT(!decode_scene(message, kWide).has_value());
}

Error any_error() {
  Error error;
  error.code = static_cast<ErrorCode>(*rc::gen::inRange(0, static_cast<int>(kLastErrorCode) + 1));
  error.what = *rc::gen::string<std::string>();
  error.where = *rc::gen::string<std::string>();
  error.remedy = *rc::gen::string<std::string>();
  error.line = *rc::gen::inRange(0, std::numeric_limits<int>::max());
  return error;
}

RC_GTEST_PROP(SceneCodec, CarriesAnErrorWhole, ()) {
  const Error error = any_error();
  const auto back = decode_scene(encode_failure(error), {});
  RC_ASSERT(!back.has_value());
  RC_ASSERT(back.error().code == error.code);
  RC_ASSERT(back.error().line == error.line);
  RC_ASSERT(back.error().what == error.what);
  RC_ASSERT(back.error().where == error.where);
  RC_ASSERT(back.error().remedy == error.remedy);
}

/// An error's message with one byte of its payload changed, and a header that fits it.
std::vector<std::byte> changed_failure(std::size_t at, std::uint8_t value) {
  std::vector<std::byte> message = encode_failure({ErrorCode::too_large, "what", "where", "remedy", 7});
  message.at(kSceneHeaderBytes + at) = std::byte{value};
  seal_scene(message, SceneMessage::failure);
  return message;
}

TEST(SceneCodec, AnErrorsCodeOrLineThatNoErrorHasIsDamage) {
  constexpr auto kLast = static_cast<std::uint8_t>(kLastErrorCode);
  EXPECT_EQ(decode_scene(changed_failure(0, kLast), {}).error().code, kLastErrorCode);
  for (const int code : {kLast + 1, 0x7f, 0xff})
    EXPECT_THAT(decode_scene(changed_failure(0, static_cast<std::uint8_t>(code)), {}).error(),
                is_error(ErrorCode::damaged, 0, {fmt::format("code {}", code)}));
  EXPECT_THAT(decode_scene(changed_failure(4, 0x80), {}).error(), is_error(ErrorCode::damaged, 0, {"line -"}));
}

TEST(SceneCodec, AnErrorThatIsCutShortIsDamage) {
  const std::vector<std::byte> whole = encode_failure({ErrorCode::too_large, "what", "where", "remedy", 7});
  for (std::size_t size = kSceneHeaderBytes; size < whole.size(); ++size) {
    std::vector<std::byte> message(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    seal_scene(message, SceneMessage::failure);
    EXPECT_THAT(decode_scene(message, {}).error(), is_error(ErrorCode::damaged, 0)) << size;
  }
}

TEST(SceneCodec, AnotherVersionIsSaid) {
  std::vector<std::byte> message = encode_failure({ErrorCode::too_large, "what", "where", "remedy"});
  message[4] = std::byte{kSceneCodecVersion + 1};
  EXPECT_THAT(decode_scene(message, {}).error(),
              is_error(ErrorCode::wrong_version, 0, {std::to_string(kSceneCodecVersion + 1)}));
}

}  // namespace
}  // namespace mechane::content
