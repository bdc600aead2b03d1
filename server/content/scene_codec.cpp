#include "server/content/scene_codec.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <type_traits>

#include <fmt/format.h>
#include <xxhash.h>

#include "server/base/assert.hpp"
#include "server/content/scene_check.hpp"

namespace mechane::content {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::array<char, 4> kMagic{'M', 'S', 'C', 'N'};
using Kind = SceneMessage;

struct Header {
  std::array<char, 4> magic = kMagic;
  std::uint32_t version = kSceneCodecVersion;
  Kind kind = Kind::scene;
  std::uint32_t zero = 0;
  std::uint64_t length = 0;
  std::uint64_t checksum = 0;
};
static_assert(sizeof(Header) == kSceneHeaderBytes && std::has_unique_object_representations_v<Header>);

void seal(std::span<std::byte> message, Kind kind) {
  Header header;
  header.kind = kind;
  header.length = message.size() - kSceneHeaderBytes;
  header.checksum = XXH3_64bits(message.data() + kSceneHeaderBytes, header.length);
  std::memcpy(message.data(), &header, sizeof header);
}

class Writer {
 public:
  Writer() : bytes_(kSceneHeaderBytes) {}

  template <class T>
  void put(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    raw(&value, sizeof value);
  }
  void put(const std::string& text) { array(std::span(text)); }
  void put(const std::optional<std::uint32_t>& index) { put(index ? *index + 1 : 0U); }  // 0: none
  template <class T>
  void array(const T& items) {
    put(static_cast<std::uint64_t>(items.size()));
    if (!items.empty()) raw(items.data(), items.size() * sizeof items[0]);
  }
  void vector(const float* values, std::size_t count) { raw(values, count * sizeof(float)); }
  void raw(const void* data, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }
  [[nodiscard]] std::vector<std::byte> finish(Kind kind) {
    seal(bytes_, kind);
    return std::move(bytes_);
  }

 private:
  std::vector<std::byte> bytes_;
};

/// Reads what Writer wrote. Once bytes are missing, every value is zero or empty and `good()` is false: one check at the end of each
/// group is enough.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : left_(bytes) {}
  [[nodiscard]] bool good() const { return good_; }
  [[nodiscard]] bool at_end() const { return good_ && left_.empty(); }

  template <class T>
  [[nodiscard]] T get() {
    T value{};
    raw(&value, sizeof value);
    return value;
  }
  [[nodiscard]] bool flag() { return get<std::uint8_t>() != 0; }
  [[nodiscard]] std::optional<std::uint32_t> index() {
    const auto plus_one = get<std::uint32_t>();
    return plus_one == 0 ? std::nullopt : std::optional(plus_one - 1);
  }
  /// A count of items that take at least `least` bytes each. A count that needs more bytes than are left is an error: it costs no memory.
  [[nodiscard]] std::size_t count(std::size_t least) {
    const auto n = get<std::uint64_t>();
    if (n > left_.size() / least) good_ = false;
    return good_ ? static_cast<std::size_t>(n) : 0;
  }
  template <class Container>
  void array(Container& items) {
    items.resize(count(sizeof items[0]));
    if (!items.empty()) raw(items.data(), items.size() * sizeof items[0]);
  }
  [[nodiscard]] std::string text() {
    std::string value;
    array(value);
    return value;
  }
  void raw(void* data, std::size_t size) {
    if (!good_ || size > left_.size()) {
      good_ = false;
      return;
    }
    std::memcpy(data, left_.data(), size);
    left_ = left_.subspan(size);
  }

 private:
  std::span<const std::byte> left_;
  bool good_ = true;
};

void put(Writer& out, const ImportedNode& node) {
  out.put(node.name);
  out.put(node.parent);
  out.raw(node.X_PN.affine().eval().data(), 12 * sizeof(double));
  out.array(node.meshes);
}

void get(Reader& in, ImportedNode& node) {
  node.name = in.text();
  node.parent = in.index();
  Eigen::Matrix<double, 3, 4> affine = Eigen::Matrix<double, 3, 4>::Zero();
  in.raw(affine.data(), 12 * sizeof(double));
  node.X_PN.affine() = affine;
  in.array(node.meshes);
}

void put(Writer& out, const ImportedMesh& mesh) {
  out.put(mesh.name);
  out.array(mesh.positions);
  out.array(mesh.normals);
  out.array(mesh.tangents);
  out.array(mesh.uv);
  out.array(mesh.indices);
  out.put(mesh.material);
}

void get(Reader& in, ImportedMesh& mesh) {
  mesh.name = in.text();
  in.array(mesh.positions);
  in.array(mesh.normals);
  in.array(mesh.tangents);
  in.array(mesh.uv);
  in.array(mesh.indices);
  mesh.material = in.get<std::uint32_t>();
}

void put(Writer& out, const ImportedMaterial& m) {
  out.put(m.name);
  out.vector(m.base_colour.data(), 4);
  out.vector(m.emissive.data(), 3);
  out.put(m.metallic);
  out.put(m.roughness);
  out.put(m.alpha_mode);
  out.put(m.alpha_cutoff);
  out.put(static_cast<std::uint8_t>(m.double_sided));
  out.put(m.base_colour_texture);
  out.put(m.normal_texture);
  out.put(m.metallic_roughness_texture);
  out.put(m.emissive_texture);
  out.put(m.occlusion_texture);
  out.put(m.occlusion_strength);
}

AlphaMode alpha_mode(std::uint8_t value) {
  return value <= static_cast<std::uint8_t>(AlphaMode::blend) ? static_cast<AlphaMode>(value) : AlphaMode::opaque;
}

void get(Reader& in, ImportedMaterial& m) {
  m.name = in.text();
  in.raw(m.base_colour.data(), 4 * sizeof(float));
  in.raw(m.emissive.data(), 3 * sizeof(float));
  m.metallic = in.get<float>();
  m.roughness = in.get<float>();
  m.alpha_mode = alpha_mode(in.get<std::uint8_t>());
  m.alpha_cutoff = in.get<float>();
  m.double_sided = in.flag();
  m.base_colour_texture = in.index();
  m.normal_texture = in.index();
  m.metallic_roughness_texture = in.index();
  m.emissive_texture = in.index();
  m.occlusion_texture = in.index();
  m.occlusion_strength = in.get<float>();
}

void put(Writer& out, const ImportedTexture& texture) {
  out.put(texture.name);
  out.put(texture.encoding);
  out.put(texture.width);
  out.put(texture.height);
  out.array(texture.bytes);
}

TextureEncoding texture_encoding(std::uint8_t value) {
  return value <= static_cast<std::uint8_t>(TextureEncoding::rgba8) ? static_cast<TextureEncoding>(value)
                                                                    : TextureEncoding::png;
}

void get(Reader& in, ImportedTexture& texture) {
  texture.name = in.text();
  texture.encoding = texture_encoding(in.get<std::uint8_t>());
  texture.width = in.get<std::uint32_t>();
  texture.height = in.get<std::uint32_t>();
  in.array(texture.bytes);
}

template <class T>
void put_all(Writer& out, const std::vector<T>& items) {
  out.put(static_cast<std::uint64_t>(items.size()));
  for (const T& item : items)
    put(out, item);
}

/// Adds items one by one, as long as there are bytes: an item takes far more memory than its shortest form in the message, so that a count
/// alone must not reserve any.
template <class T>
void get_all(Reader& in, std::vector<T>& items, std::size_t most) {
  const std::size_t count = in.count(sizeof(std::uint64_t));
  for (std::size_t i = 0; i < count && i <= most && in.good(); ++i)
    get(in, items.emplace_back());
}

constexpr const char* kTryAgain = "try again; if this happens again, reinstall Mechane";

tl::unexpected<Error> damaged(const std::string& how) {
  return fail(ErrorCode::damaged, "the result of the mesh import is damaged: " + how, {}, kTryAgain);
}

/// The error of a failure message. A code or a line that encode_failure never writes is damage.
tl::unexpected<Error> failure_in(Reader& in) {
  const auto code = in.get<std::uint8_t>();
  const auto line = in.get<std::int32_t>();
  Error error;
  error.what = in.text();
  error.where = in.text();
  error.remedy = in.text();
  if (!in.at_end()) return damaged("its error is cut short");
  if (code > static_cast<std::uint8_t>(kLastErrorCode)) return damaged(fmt::format("its error has the code {}", code));
  if (line < 0) return damaged(fmt::format("its error is in line {}", line));
  error.code = static_cast<ErrorCode>(code);
  error.line = line;
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace

std::vector<std::byte> encode_scene(const ImportedScene& scene) {
  Writer out;
  put_all(out, scene.nodes);
  put_all(out, scene.meshes);
  put_all(out, scene.materials);
  put_all(out, scene.textures);
  return out.finish(Kind::scene);
}

std::vector<std::byte> encode_failure(const Error& error) {
  Writer out;
  out.put(error.code);
  out.put(static_cast<std::int32_t>(error.line));
  out.put(error.what);
  out.put(error.where);
  out.put(error.remedy);
  return out.finish(Kind::failure);
}

void seal_scene(std::span<std::byte> message, SceneMessage kind) {
  MECHANE_ASSERT(message.size() >= kSceneHeaderBytes);
  seal(message, kind);
}

std::uint64_t longest_message(const ImportLimits& limits) {
  constexpr std::uint64_t kName =
      1200;  // longest name (assimp's strings end at 1024), lengths and fixed fields of an item
  const std::uint64_t items = std::uint64_t{limits.nodes} * 2 + limits.meshes + limits.materials + limits.textures;
  return (1U << 16U) + items * kName + limits.vertices * 48 + limits.triangles * 12 + limits.texture_bytes;
}

Expected<ImportedScene> decode_scene(std::span<const std::byte> message, const ImportLimits& limits) {
  Header header;
  if (message.size() < sizeof header) return damaged(fmt::format("{} bytes instead of a header", message.size()));
  std::memcpy(&header, message.data(), sizeof header);
  if (header.magic != kMagic) return damaged("it does not begin with MSCN");
  if (header.zero != 0) return damaged("its header has a wrong field");
  if (header.version != kSceneCodecVersion) {
    return fail(ErrorCode::wrong_version,
                fmt::format("the program that imports meshes is of another version: its results have version {}, this "
                            "program reads version {}",
                            header.version, kSceneCodecVersion),
                {}, "reinstall Mechane, so that all its programs are of one version");
  }
  const std::span<const std::byte> payload = message.subspan(sizeof header);
  if (payload.size() != header.length) return damaged(fmt::format("{} bytes of {}", payload.size(), header.length));
  if (XXH3_64bits(payload.data(), payload.size()) != header.checksum) return damaged("its checksum is wrong");
  Reader in(payload);
  if (header.kind == Kind::failure) return failure_in(in);
  if (header.kind != Kind::scene) return damaged("it is neither a scene nor an error");
  ImportedScene scene;
  get_all(in, scene.nodes, limits.nodes);
  get_all(in, scene.meshes, limits.meshes);
  get_all(in, scene.materials, limits.materials);
  get_all(in, scene.textures, limits.textures);
  if (!in.good()) return damaged("it is cut short");
  // A list over its limit is cut after one item too many, which check_scene then reports.
  if (auto good = check_scene(scene, limits); !good) return tl::unexpected<Error>(good.error());
  if (!in.at_end()) return damaged("bytes follow its last part");
  return scene;
}

}  // namespace mechane::content
