#include "server/collision/object_io.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>
#include <type_traits>

#define XXH_INLINE_ALL  // so that users of this library need not link xxhash
#include <xxhash.h>

#include "server/base/whole_file.hpp"
#include "server/collision/samples.hpp"

namespace mechane::collision {
namespace {

static_assert(std::endian::native == std::endian::little, "a .part file is little endian and is read in place");

constexpr std::string_view kMagic = "MCHNPART";
constexpr std::size_t kChecksumBytes = 8;
constexpr std::size_t kMaxFileBytes = 512U << 20;
constexpr std::uint32_t kMaxNameBytes = 1024;
constexpr double kMaxLength_m = 10'000;
// The first byte of a part's map: its kind.
constexpr std::uint8_t kNothing = 0;
constexpr std::uint8_t kRadial = 1;
constexpr std::uint8_t kBrick = 2;
constexpr std::uint8_t kField = 3;

std::uint64_t checksum(std::span<const std::byte> bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

class Writer {
 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void put(T value) {
    const auto* raw = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), raw, raw + sizeof value);
  }
  template <class T>
  void put_all(std::span<const T> values) {
    for (const T value : values)
      put(value);
  }
  template <class Vector>
  void put_vector(const Vector& v) {
    for (int i = 0; i < 3; ++i)
      put(v[i]);
  }
  void put_text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    put_raw(text);
  }
  void put_raw(std::string_view text) {
    for (const char c : text)
      bytes_.push_back(static_cast<std::byte>(c));
  }
  void put_sphere(const geometry::Sphere& s) {
    put_vector(s.center);
    put(s.radius);
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Reads values one after the other; after the first failure everything reads as zero and `ok` stays false.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T> T get() {
    T value{};
    if (!has(sizeof value)) return value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  Vec3 get_vec3() {
    const double x = get<double>();
    const double y = get<double>();
    return {x, y, get<double>()};
  }
  Vec3f get_vec3f() {
    const float x = get<float>();
    const float y = get<float>();
    return {x, y, get<float>()};
  }
  std::string get_text() {
    const auto size = get<std::uint32_t>();
    require(size <= kMaxNameBytes);
    if (!has(size)) return {};
    std::string text(reinterpret_cast<const char*>(bytes_.data() + at_), size);
    at_ += size;
    return text;
  }
  geometry::Sphere get_sphere() {
    geometry::Sphere s;
    s.center = get_vec3();
    s.radius = get<double>();
    require(s.center.allFinite() && s.center.cwiseAbs().maxCoeff() <= kMaxLength_m);
    require(s.radius >= 0 && s.radius <= kMaxLength_m);
    return s;
  }
  /// A count of things of at least `least_bytes` each: never more than the bytes left could hold.
  std::uint32_t get_count(std::size_t least_bytes) {
    const auto count = get<std::uint32_t>();
    require(count <= (bytes_.size() - at_) / least_bytes);
    return ok_ ? count : 0;
  }
  /// `count` values; an empty list if there are fewer.
  template <class T>
  std::vector<T> get_all(std::size_t count) {
    require(count <= (bytes_.size() - at_) / sizeof(T));
    std::vector<T> values(ok_ ? count : 0);
    for (T& value : values)
      value = get<T>();
    return values;
  }
  void require(bool condition) { ok_ = ok_ && condition; }
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }

 private:
  bool has(std::size_t count) {
    require(count <= bytes_.size() - at_);
    return ok_;
  }
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

void put_grid(Writer& w, const DistanceBrick::Grid& grid) {
  for (const int n : grid.blocks)
    w.put(static_cast<std::uint16_t>(n));
  w.put_vector(grid.origin_Q);
  w.put(grid.block_m);
}

void put_map(Writer& w, const PartMap& map) {
  w.put(map.radial() != nullptr  ? kRadial
        : map.brick() != nullptr ? kBrick
        : map.field() != nullptr ? kField
                                 : kNothing);
  if (const RadialMap* radial = map.radial()) {
    w.put(static_cast<std::uint32_t>(radial->resolution()));
    w.put_vector(radial->center_Q());
    w.put_vector(radial->half_Q());
    w.put(radial->sigma_step());
    w.put_all(radial->texels());
  } else if (const DistanceBrick* brick = map.brick()) {
    put_grid(w, brick->grid());
    w.put(brick->step_m());
    w.put(brick->slack_m());
    w.put(static_cast<std::uint32_t>(brick->values().size()));
    w.put_all(brick->index());
    w.put_all(brick->values());
  } else if (const DistanceField* field = map.field()) {
    const DistanceField::Data& data = field->data();
    put_grid(w, data.grid);
    w.put(data.slack_m);
    w.put(static_cast<std::uint32_t>(data.children.size()));
    w.put(static_cast<std::uint32_t>(data.slots.size()));
    w.put_all(std::span(data.entries));
    w.put_all(std::span(data.children));
    for (const DistanceField::Slot& slot : data.slots)
      w.put_all(std::span<const std::uint8_t>(slot));
  }
}

void put_part(Writer& w, const Part& part) {
  w.put_text(part.name);
  w.put_vector(part.X_OQ.p);
  for (int i = 0; i < 4; ++i)
    w.put(part.X_OQ.R.coeffs()[i]);
  const geometry::Superquadric& s = part.superquadric;
  w.put_vector(s.a);
  for (const double v : {s.e1, s.e2, s.taper_x, s.taper_y, s.bend_per_m, s.bend_angle_rad})
    w.put(v);
  w.put_sphere(part.bound_O);
  put_map(w, part.map);
}

PartMap get_radial(Reader& r) {
  const auto resolution = r.get<std::uint32_t>();
  const Vec3f center_Q = r.get_vec3f();
  const Vec3f half_Q = r.get_vec3f();
  const auto step = r.get<float>();
  r.require(resolution <= static_cast<std::uint32_t>(RadialMap::kResolutions.back()));
  const std::size_t count = r.ok() ? std::size_t{6} * resolution * resolution : 0;
  r.require(RadialMap::is_valid(static_cast<int>(resolution), center_Q, half_Q, step, count));
  std::vector<std::uint16_t> texels = r.get_all<std::uint16_t>(count);
  if (!r.ok()) return {};
  return RadialMap(static_cast<int>(resolution), center_Q, half_Q, step, std::move(texels));
}

DistanceBrick::Grid get_grid(Reader& r) {
  DistanceBrick::Grid grid;
  for (int& n : grid.blocks)
    n = r.get<std::uint16_t>();
  grid.origin_Q = r.get_vec3f();
  grid.block_m = r.get<float>();
  return grid;
}

PartMap get_brick(Reader& r) {
  const DistanceBrick::Grid grid = get_grid(r);
  const auto step = r.get<float>();
  const auto slack = r.get<float>();
  const auto count = r.get<std::uint32_t>();
  r.require(DistanceBrick::is_valid(grid));
  std::vector<std::uint32_t> index = r.get_all<std::uint32_t>(r.ok() ? grid.block_count() : 0);
  const std::vector<std::int8_t> values = r.get_all<std::int8_t>(r.ok() ? count : 0);
  r.require(r.ok() && DistanceBrick::is_valid(grid, step, slack, index, values.size()));
  if (!r.ok()) return {};
  return DistanceBrick(grid, step, slack, std::move(index), values);
}

PartMap get_field(Reader& r) {
  DistanceField::Data data;
  data.grid = get_grid(r);
  data.slack_m = r.get<float>();
  const auto children = r.get<std::uint32_t>();
  const auto slots = r.get<std::uint32_t>();
  r.require(DistanceBrick::is_valid(data.grid));
  data.entries = r.get_all<std::uint64_t>(r.ok() ? data.grid.block_count() : 0);
  data.children = r.get_all<std::uint32_t>(r.ok() ? children : 0);
  const std::size_t slot_bytes = sizeof(DistanceField::Slot) * std::size_t{slots};
  const std::vector<std::uint8_t> bytes = r.get_all<std::uint8_t>(r.ok() ? slot_bytes : 0);
  data.slots.resize(bytes.size() / sizeof(DistanceField::Slot));
  if (!bytes.empty()) std::memcpy(data.slots.data(), bytes.data(), bytes.size());
  r.require(r.ok() && DistanceField::is_valid(data));
  if (!r.ok()) return {};
  return DistanceField(std::move(data));
}

PartMap get_map(Reader& r) {
  const auto kind = r.get<std::uint8_t>();
  r.require(kind <= kField);
  if (!r.ok() || kind == kNothing) return {};
  return kind == kRadial ? get_radial(r) : kind == kBrick ? get_brick(r) : get_field(r);
}

Part get_part(Reader& r) {
  Part part;
  part.name = r.get_text();
  part.X_OQ.p = r.get_vec3();
  for (int i = 0; i < 4; ++i)
    part.X_OQ.R.coeffs()[i] = r.get<double>();
  r.require(part.X_OQ.p.allFinite() && part.X_OQ.p.cwiseAbs().maxCoeff() <= kMaxLength_m);
  r.require(std::abs(part.X_OQ.R.squaredNorm() - 1) < 1e-6);
  geometry::Superquadric& s = part.superquadric;
  s.a = r.get_vec3();
  for (double* v : {&s.e1, &s.e2, &s.taper_x, &s.taper_y, &s.bend_per_m, &s.bend_angle_rad})
    *v = r.get<double>();
  r.require(geometry::is_valid(s) && s.a.maxCoeff() <= kMaxLength_m);
  part.bound_O = r.get_sphere();
  part.map = get_map(r);
  return part;
}

Cluster get_cluster(Reader& r) {
  Cluster c;
  c.bound_O = r.get_sphere();
  c.count = r.get<std::uint16_t>();
  c.part = r.get<std::uint16_t>();
  r.require(c.count >= 1 && c.count <= kLanes);
  Vec3f first = Vec3f::Zero();
  for (std::size_t lane = 0; lane < kLanes && r.ok(); ++lane) {
    const Vec3f p = lane < c.count ? r.get_vec3f() : first;
    r.require(p.allFinite() && p.cwiseAbs().maxCoeff() <= static_cast<float>(kMaxLength_m));
    if (lane == 0) first = p;
    c.samples_O.x[lane] = p.x();
    c.samples_O.y[lane] = p.y();
    c.samples_O.z[lane] = p.z();
  }
  return c;
}

void get_clusters(Reader& r, Object& object) {
  const std::uint32_t clusters = r.get_count(4 * sizeof(double) + 2 * sizeof(std::uint16_t) + 3 * sizeof(float));
  for (std::uint32_t i = 0; i < clusters && r.ok(); ++i) {
    const Cluster c = get_cluster(r);
    r.require(c.part < object.parts.size() && (object.clusters.empty() || c.part >= object.clusters.back().part));
    object.clusters.push_back(c);
  }
}

}  // namespace

std::vector<std::byte> write_object(const Object& object) {
  Writer w;
  w.put_raw(kMagic);
  const bool has_field = std::any_of(object.parts.begin(), object.parts.end(),
                                     [](const Part& part) { return part.map.field() != nullptr; });
  w.put(has_field ? kFieldFileVersion : kPartFileVersion);
  w.put(static_cast<std::uint32_t>(object.parts.size()));
  for (const Part& part : object.parts)
    put_part(w, part);
  w.put(static_cast<std::uint32_t>(object.clusters.size()));
  for (const Cluster& c : object.clusters) {
    w.put_sphere(c.bound_O);
    w.put(c.count);
    w.put(c.part);
    for (std::size_t lane = 0; lane < c.count; ++lane)
      w.put_vector(c.sample_O(lane));
  }
  w.put(std::uint64_t{0});
  std::vector<std::byte> bytes = w.take();
  reseal(bytes);
  return bytes;
}

void reseal(std::span<std::byte> bytes) {
  if (bytes.size() < kChecksumBytes) return;
  const std::uint64_t sum = checksum(bytes.first(bytes.size() - kChecksumBytes));
  std::memcpy(bytes.data() + bytes.size() - kChecksumBytes, &sum, sizeof sum);
}

Expected<Object> read_object(std::span<const std::byte> bytes) {
  const char* where = "part file";
  const char* remedy =
      "make it again from its mesh with 'mechane fit' or build_object; the server's cache makes its own again by "
      "itself";
  if (bytes.size() < kMagic.size() + 4 + kChecksumBytes || bytes.size() > kMaxFileBytes ||
      std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0) {
    return fail(ErrorCode::damaged, "this is not a part file", where, remedy);
  }
  std::uint32_t version = 0;
  std::memcpy(&version, bytes.data() + kMagic.size(), sizeof version);
  if (version < kPartFileVersion || version > kFieldFileVersion) {
    return fail(ErrorCode::wrong_version,
                "the part file has version " + std::to_string(version) + ", but this program reads versions " +
                    std::to_string(kPartFileVersion) + " to " + std::to_string(kFieldFileVersion),
                where, remedy);
  }
  const auto body = bytes.first(bytes.size() - kChecksumBytes);
  std::uint64_t stored = 0;
  std::memcpy(&stored, bytes.data() + body.size(), sizeof stored);
  if (stored != checksum(body))
    return fail(ErrorCode::damaged, "the part file is damaged: its checksum does not match", where, remedy);

  Reader r(body.subspan(kMagic.size() + sizeof version));
  Object object;
  const auto parts = r.get<std::uint32_t>();
  r.require(parts >= 1 && parts <= kMaxParts);
  for (std::uint32_t i = 0; i < parts && r.ok(); ++i)
    object.parts.push_back(get_part(r));
  if (r.ok()) get_clusters(r, object);
  if (!r.ok() || !r.at_end()) return fail(ErrorCode::damaged, "the part file holds impossible values", where, remedy);
  close_clusters(object);
  return object;
}

Expected<Object> load_object(const std::filesystem::path& file) {
  const Expected<std::vector<std::byte>> bytes = read_whole(file, kMaxFileBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  Expected<Object> object = read_object(*bytes);
  if (!object) object.error().where = file.string();
  return object;
}

}  // namespace mechane::collision
