#include "client-sdk/scene/landscape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/base/random.hpp"

namespace mechane::scene {
namespace {

constexpr float kBrushland_m = 40;  ///< from the clearing's edge, like the next
constexpr float kTreeline_m = 190;  ///< farther away, haze hides everything
constexpr int kBrush = 70;
constexpr int kTrees = 140;
constexpr int kCypresses = 9;
/// Leaves of a tree near the viewer, and the distance up to which it has so many.
constexpr float kLeaves = 420;
constexpr float kNear_m = 30;
constexpr float kBank_m = 2.5F;
/// Height above the plain, because modelled ground lies a little higher.
constexpr float kShadeHeight_m = 0.09F;

constexpr float kGoldenShare = 0.61803399F;

Vec3f direction(ShortRandom& random) {
  const float y = random.between(-1, 1);
  const float a = random.between(0, kTwoPiF);
  const float r = std::sqrt(std::max(1 - y * y, 0.0F));
  return {r * std::cos(a), y, r * std::sin(a)};
}

/// Density of the groves at a place.
float thickness(const LandscapePlan& plan, const Vec3f& p_W) {
  const Vec3f q = p_W - plan.middle_W;
  const auto phase = static_cast<float>(plan.seed % 628) / 100;
  return 0.55F + 0.22F * (std::sin(0.071F * q.x() + phase) + std::sin(0.058F * q.z() - phase) +
                          0.6F * std::sin(0.041F * (q.x() - q.z()) + phase));
}

/// All plant triangles of one material.
class Growth {
 public:
  void quad(const std::array<Vec3f, 4>& p_W, const Vec3f& n_W) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    constexpr std::array<std::array<float, 2>, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (std::size_t k = 0; k < 4; ++k) {
      mesh_.positions.push_back(p_W[k]);
      mesh_.normals.push_back(n_W);
      mesh_.uv.emplace_back(kCorners[k][0], kCorners[k][1]);
    }
    // The front faces along the normal; the shader reverses the normal behind.
    const bool along = (p_W[1] - p_W[0]).cross(p_W[2] - p_W[0]).dot(n_W) > 0;
    const std::uint32_t b = along ? 1 : 3;
    const std::uint32_t d = along ? 3 : 1;
    mesh_.indices.insert(mesh_.indices.end(), {first, first + b, first + 2, first, first + 2, first + d});
  }

  /// A limb: six sides, thinner to its end.
  void limb(const Vec3f& from_W, const Vec3f& to_W, float thick_m, float thin_m) {
    constexpr std::uint32_t kSides = 6;
    const Vec3f along = (to_W - from_W).normalized();
    const Vec3f side = along.unitOrthogonal();
    const Vec3f other = along.cross(side);
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const float a = kTwoPiF * static_cast<float>(k) / kSides;
      const Vec3f out = std::cos(a) * side + std::sin(a) * other;
      for (const bool end : {false, true}) {
        mesh_.positions.push_back(end ? Vec3f(to_W + thin_m * out) : Vec3f(from_W + thick_m * out));
        mesh_.normals.push_back(out);
        mesh_.uv.emplace_back(static_cast<float>(k) / kSides, end ? 1.0F : 0.0F);
      }
      const std::uint32_t at = first + 2 * k;
      const std::uint32_t next = first + 2 * ((k + 1) % kSides);
      mesh_.indices.insert(mesh_.indices.end(), {at, next, at + 1, next, next + 1, at + 1});
    }
  }

  [[nodiscard]] picture::MeshData take() { return std::move(mesh_); }

 private:
  picture::MeshData mesh_;
};

struct Grown {
  Growth bark, pale, dark, cypress, shade;
};

struct Crown {
  Vec3f p_W;
  Vec3f half_m;
  float leaf_m;
  int leaves;
};

/// A ball of short leafy twigs: grey-green above, dark below and inside.
void add_crown(const Crown& crown, Growth& pale, Growth& dark, ShortRandom& random) {
  for (int k = 0; k < crown.leaves; ++k) {
    const Vec3f out = direction(random);
    const float depth = random.between(0.60F, 1.0F);
    const Vec3f p_W = crown.p_W + depth * out.cwiseProduct(crown.half_m);
    const Vec3f a = crown.leaf_m * direction(random);
    const Vec3f b = 0.6F * crown.leaf_m * a.cross(direction(random)).normalized();
    const bool bright = 0.5F + 0.5F * out.y() + 1.2F * (depth - 0.85F) + random.between(-0.25F, 0.25F) > 0.45F;
    const Vec3f n_W = (out + 0.5F * direction(random) + Vec3f(0, 0.15F, 0)).normalized();
    (bright ? pale : dark).quad({p_W - a, p_W + b, p_W + a, p_W - b}, n_W);
  }
}

/// How coarse a plant may be: 1 near the viewer, 2 at twice the distance, and so on up to 6, where a leaf stands for a
/// tuft.
float coarseness(const LandscapePlan& plan, const Plant& plant) {
  return std::clamp((plant.p_W - plan.middle_W).norm() / kNear_m, 1.0F, 6.0F);
}

void add_olive(const Plant& plant, float coarse, Grown& out) {
  ShortRandom random(plant.seed);
  const float h = plant.height_m;
  const float leaf_m = 0.030F * h * std::sqrt(coarse);
  const int leaves = static_cast<int>(kLeaves / coarse / 4);
  const Vec3f fork =
      plant.p_W + h * Vec3f{random.between(-0.05F, 0.05F), random.between(0.25F, 0.31F), random.between(-0.05F, 0.05F)};
  out.bark.limb(plant.p_W - Vec3f(0, 0.2F, 0), fork, 0.055F * h, 0.036F * h);
  const float turn = random.between(0, 2);
  for (int k = 0; k < 3; ++k) {
    const float a = turn + 2.094F * static_cast<float>(k) + random.between(-0.3F, 0.3F);
    const Vec3f tip = fork + h * Vec3f(0.24F * std::cos(a), random.between(0.22F, 0.32F), 0.24F * std::sin(a));
    out.bark.limb(fork, tip, 0.029F * h, 0.010F * h);
    const float r = h * random.between(0.20F, 0.26F);
    add_crown({tip + Vec3f(0, 0.03F * h, 0), {r, 0.78F * r, r}, leaf_m, leaves}, out.pale, out.dark, random);
  }
  const float r = 0.28F * h;
  add_crown({fork + Vec3f(0, 0.36F * h, 0), {r, 0.80F * r, r}, leaf_m, leaves}, out.pale, out.dark, random);
}

void add_cypress(const Plant& plant, float coarse, Grown& out) {
  ShortRandom random(plant.seed);
  const float h = plant.height_m;
  out.bark.limb(plant.p_W - Vec3f(0, 0.2F, 0), plant.p_W + Vec3f(0, 0.2F * h, 0), 0.022F * h, 0.018F * h);
  // An opaque core, because a cypress is too dense to be looked through.
  out.cypress.limb(plant.p_W + Vec3f(0, 0.12F * h, 0), plant.p_W + Vec3f(0, 0.45F * h, 0), 0.045F * h, 0.080F * h);
  out.cypress.limb(plant.p_W + Vec3f(0, 0.45F * h, 0), plant.p_W + Vec3f(0, 0.88F * h, 0), 0.080F * h, 0.012F * h);
  const int sprays = static_cast<int>(300 / coarse);
  for (int k = 0; k < sprays; ++k) {
    const float t = random.between(0, 1);
    const float r = 0.105F * h * std::pow(std::sin(kPiF * (0.12F + 0.86F * t)), 0.8F) * (1 - 0.35F * t);
    const float a = random.between(0, kTwoPiF);
    const Vec3f outwards(std::cos(a), 0, std::sin(a));
    const Vec3f p_W = plant.p_W + r * outwards + Vec3f(0, (0.08F + 0.86F * t) * h, 0);
    const Vec3f side = 0.017F * h * std::sqrt(coarse) * Vec3f(-std::sin(a), 0, std::cos(a));
    const Vec3f foot = p_W + 0.015F * h * outwards - Vec3f(0, 0.02F * h, 0);
    const Vec3f n_W = (outwards + Vec3f(0, 0.3F, 0) + 0.35F * direction(random)).normalized();
    out.cypress.quad({p_W - side, foot, p_W + side, p_W + Vec3f(0, 0.085F * h, 0)}, n_W);
  }
}

void add_brush(const Plant& plant, float coarse, Grown& out) {
  ShortRandom random(plant.seed);
  const float h = plant.height_m;
  for (int k = 0; k < 3; ++k) {
    const float r = h * random.between(0.45F, 0.75F);
    const Vec3f p_W = plant.p_W + Vec3f{random.between(-h, h), 0.45F * r, random.between(-h, h)};
    const float leaf_m = 0.10F * std::sqrt(coarse);
    add_crown({p_W, {r, 0.8F * r, r}, leaf_m, static_cast<int>(48 / coarse)}, k == 0 ? out.pale : out.dark, out.dark,
              random);
  }
}

/// The soft shadow of a plant's crown on the ground; it is too far away for a shadow map.
void add_shade(const Plant& plant, const Vec3f& to_sun_W, Growth& shade) {
  const bool cypress = plant.kind == Plant::Kind::cypress;
  const float h = plant.height_m;
  const float wide = cypress ? 0.12F * h : plant.kind == Plant::Kind::brush ? 1.5F * h : 0.52F * h;
  const float tall = cypress ? 0.95F * h : wide;
  const float middle = cypress ? 0.5F * h : plant.kind == Plant::Kind::brush ? 0.4F * h : 0.62F * h;
  const Vec3f level(to_sun_W.x(), 0, to_sun_W.z());
  const float slope = level.norm() / std::max(to_sun_W.y(), 0.2F);
  const Vec3f along = level.norm() > 1e-3F ? Vec3f(level.normalized()) : Vec3f(Vec3f::UnitX());
  const Vec3f across = along.cross(Vec3f::UnitY());
  const Vec3f p_W = plant.p_W - middle * slope * along + Vec3f(0, kShadeHeight_m, 0);
  const Vec3f a = (cypress ? 0.5F * tall * slope + wide : std::hypot(wide, 0.6F * wide * slope)) * along;
  const Vec3f b = wide * across;
  shade.quad({p_W - a - b, p_W + a - b, p_W + a + b, p_W - a + b}, Vec3f::UnitY());
}

/// Dark in the middle, transparent at the rim.
picture::ImageData shade_image() {
  constexpr std::uint32_t kSide = 64;
  picture::ImageData image{kSide, kSide, {}, true};
  for (std::uint32_t row = 0; row < kSide; ++row) {
    for (std::uint32_t column = 0; column < kSide; ++column) {
      const auto from_middle = [](std::uint32_t k) { return (2 * static_cast<float>(k) + 1) / kSide - 1; };
      const float r = std::hypot(from_middle(row), from_middle(column));
      const float share = std::clamp((1 - r) / 0.45F, 0.0F, 1.0F);
      const auto opacity = static_cast<std::uint8_t>(175 * share * share * (3 - 2 * share));
      image.rgba.insert(image.rgba.end(), {0, 0, 0, opacity});
    }
  }
  return image;
}

picture::MaterialData leaf(float r, float g, float b) {
  picture::MaterialData material;
  material.base_colour = Eigen::Vector4f(r, g, b, 1);
  material.roughness = 0.9F;
  material.double_sided = true;
  return material;
}

picture::MaterialData shade_material(AssetLibrary& library) {
  picture::MaterialData material;
  material.base_colour_image = library.add_image(shade_image());
  material.roughness = 1;
  material.clear = true;
  return material;
}

float distance_to_segment_m(const Eigen::Vector2f& p, const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  const Eigen::Vector2f ab = b - a;
  const float t = std::clamp((p - a).dot(ab) / std::max(ab.squaredNorm(), 1e-12F), 0.0F, 1.0F);
  return (p - a - t * ab).norm();
}

/// Whether a place is in water or on its bank, seen from above.
bool is_wet(const LandscapePlan& plan, const Vec3f& p_W) {
  const auto above = [](const Vec3f& p) { return Eigen::Vector2f(p.x(), p.z()); };
  const Eigen::Vector2f p = above(p_W);
  return std::ranges::any_of(plan.waters_W, [&](const std::array<Vec3f, 3>& triangle) {
    std::array<float, 3> side{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector2f a = above(triangle[k]);
      const Eigen::Vector2f b = above(triangle[(k + 1) % 3]);
      if (distance_to_segment_m(p, a, b) < kBank_m) return true;
      side[k] = (b - a).x() * (p - a).y() - (b - a).y() * (p - a).x();
    }
    return std::ranges::all_of(side, [](float s) { return s > 0; }) ||
           std::ranges::all_of(side, [](float s) { return s < 0; });
  });
}

void scatter(const LandscapePlan& plan, Plant::Kind kind, int count, float reach_m, std::vector<Plant>& out) {
  ShortRandom random(plan.seed, 1 + static_cast<std::uint32_t>(kind));
  const float turn = random.between(0, 1);
  for (int tries = 0, made = 0; made < count && tries < 20 * count; ++tries) {
    // Denser near the clearing, where single plants are visible.
    const float away = plan.clearing_m + reach_m * std::pow(random.between(0, 1), 1.35F);
    // Evenly spread in all directions, whichever of them are left out.
    const float a =
        kTwoPiF * std::fmod(kGoldenShare * static_cast<float>(tries) + turn + random.between(0, 0.02F), 1.0F);
    Plant plant{kind, plan.middle_W + away * Vec3f(std::cos(a), 0, std::sin(a)), 1,
                1000 * plan.seed + static_cast<std::uint32_t>(tries)};
    const float size = random.between(0, 1);
    plant.height_m = kind == Plant::Kind::olive     ? 3.0F + 1.4F * size
                     : kind == Plant::Kind::cypress ? 6.5F + 3 * size
                                                    : 0.35F + 0.4F * size;
    const float wanted = kind == Plant::Kind::olive ? random.between(0.15F, 0.85F) : 0;
    if (thickness(plan, plant.p_W) < wanted || is_wet(plan, plant.p_W)) continue;
    out.push_back(plant);
    ++made;
  }
}

}  // namespace

void add_water(const picture::MeshData& mesh_M, const Eigen::Affine3f& X_WM, LandscapePlan& plan) {
  for (std::size_t i = 0; i + 2 < mesh_M.indices.size(); i += 3) {
    auto& triangle = plan.waters_W.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      triangle[k] = X_WM * mesh_M.positions[mesh_M.indices[i + k]];
  }
}

std::vector<Plant> plants_of(const LandscapePlan& plan) {
  std::vector<Plant> out;
  scatter(plan, Plant::Kind::olive, kTrees, kTreeline_m, out);
  scatter(plan, Plant::Kind::cypress, kCypresses, kTreeline_m, out);
  scatter(plan, Plant::Kind::brush, kBrush, kBrushland_m, out);
  return out;
}

PlantMeshes grow(const LandscapePlan& plan, const std::vector<Plant>& plants) {
  Grown grown;
  for (const Plant& plant : plants) {
    const float coarse = coarseness(plan, plant);
    switch (plant.kind) {
      case Plant::Kind::olive:
        add_olive(plant, coarse, grown);
        break;
      case Plant::Kind::cypress:
        add_cypress(plant, coarse, grown);
        break;
      case Plant::Kind::brush:
        add_brush(plant, coarse, grown);
        break;
    }
    add_shade(plant, plan.to_sun_W, grown.shade);
  }
  return {grown.bark.take(), grown.pale.take(), grown.dark.take(), grown.cypress.take(), grown.shade.take()};
}

std::vector<picture::Instance> add_plants(PlantMeshes meshes, AssetLibrary& library) {
  std::vector<picture::Instance> out;
  const auto add = [&](picture::MeshData& mesh, const picture::MaterialData& material) {
    if (mesh.indices.empty()) return;
    out.push_back({library.add_mesh(std::move(mesh)),
                   library.add_material(material),
                   Eigen::Affine3f::Identity(),
                   false,
                   {},
                   false});
  };
  add(meshes.bark, leaf(0.200F, 0.165F, 0.125F));
  add(meshes.pale, leaf(0.265F, 0.295F, 0.165F));
  add(meshes.dark, leaf(0.135F, 0.165F, 0.078F));
  add(meshes.cypress, leaf(0.055F, 0.085F, 0.038F));
  add(meshes.shade, shade_material(library));
  return out;
}

}  // namespace mechane::scene
