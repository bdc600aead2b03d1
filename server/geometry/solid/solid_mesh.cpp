#include "server/geometry/solid/solid_mesh.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <system_error>
#include <utility>

#include "server/base/parallel.hpp"
#include "server/geometry/mesh_check.hpp"
#include "server/geometry/mesh_query.hpp"
#include "server/geometry/solid/membrane.hpp"
#include "server/geometry/solid/mesh_orient.hpp"
#include "server/geometry/solid/outer_surface.hpp"
#include "server/geometry/solid/sheet.hpp"
#include "server/geometry/solid/shells.hpp"
#include "server/geometry/surface_samples.hpp"

namespace mechane::geometry {
namespace {

constexpr std::size_t kPlaces = 200;  // at which a shell is asked
constexpr std::uint64_t kSeed = 1;
constexpr double kBackToBack =
    0.9;  // of a shell's triangles: it is a surface with two sides, no place where two bodies touch
constexpr double kInverted = -0.05;     // mean winding number on a patch of which the inner side is outside
constexpr double kEnclosed = 0.6;       // a winding number to speak of: a dish as deep as a tenth of its width has it
constexpr double kEnclosing = 0.25;     // of a shell's area: with less before it, it is a sheet
constexpr double kMembraneCells = 256;  // of a membrane, along the diagonal
constexpr std::size_t kCleanPlaces = 2000;  // of a closed mesh: all outer, and it stays as it is

MeshQuery winding_query(const Mesh& mesh) {
  return MeshQuery(mesh, Inside::by_winding_number);
}

/// Of triangles with the same corners, leaves one: in shells that consist of them, as exporters make where both sides shall be seen.
std::size_t drop_doubles(Mesh& mesh) {
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> first_of;
  std::vector<bool> drop(mesh.triangles.size());
  for (const Shell& shell : shells_of(mesh)) {
    std::vector<std::uint32_t> seconds;
    for (const std::uint32_t i : shell) {
      auto corners = mesh.triangles[i];
      std::sort(corners.begin(), corners.end());
      if (!first_of.try_emplace(corners, i).second) seconds.push_back(i);
    }
    if (2 * static_cast<double>(seconds.size()) < kBackToBack * static_cast<double>(shell.size())) continue;
    for (const std::uint32_t i : seconds)
      drop[i] = true;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!drop[i]) mesh.triangles[kept++] = mesh.triangles[i];
  }
  const std::size_t dropped = mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  return dropped;
}

/// Places of a patch, with the winding numbers right before them.
struct Asked {
  std::vector<double> by_all, by_itself;
};

Asked ask(const Mesh& patch, const MeshQuery& all, double diagonal_m) {
  const MeshQuery own = winding_query(patch);
  Asked asked;
  for (const SurfaceSample& place : sample_by_area(patch, kPlaces, kSeed)) {
    const Vec3 n = own.triangle_normal(place.triangle);
    asked.by_all.push_back(winding_before(all, place.p, n, diagonal_m));
    asked.by_itself.push_back(winding_before(own, place.p, n, diagonal_m));
  }
  return asked;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values)
    sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

/// Turns open patches that face inwards, but for the walls of hollows. Closed shells are turn_outwards' business.
std::size_t turn_open_patches(Mesh& mesh) {
  const MeshQuery all = winding_query(mesh);
  const double diagonal_m = mesh.bounds().diagonal().norm();
  std::size_t turned = 0;
  for (const Shell& patch : patches_of(mesh)) {
    const Mesh alone = mesh_of(mesh, patch);
    if (open_edges(alone) == 0) continue;
    const Asked asked = ask(alone, all, diagonal_m);
    const double own = mean(asked.by_itself);
    // On the surface itself it is greater by a half than right before it.
    if (own + 0.5 >= kInverted || mean(asked.by_all) - own > 0.5) continue;
    for (const std::uint32_t i : patch)
      std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    turned += patch.size();
  }
  return turned;
}

std::size_t turned_triangles(const Mesh& before, const Mesh& after) {
  std::size_t turned = 0;
  for (std::size_t i = 0; i < before.triangles.size(); ++i)
    turned += before.triangles[i] != after.triangles[i] ? 1 : 0;
  return turned;
}

bool is_sheet(const Mesh& shell, const MeshQuery& all, double diagonal_m) {
  const Asked asked = ask(shell, all, diagonal_m);
  const auto enclosing =
      std::count_if(asked.by_all.begin(), asked.by_all.end(), [](double before) { return before + 1 > kEnclosed; });
  return static_cast<double>(enclosing) < kEnclosing * static_cast<double>(asked.by_all.size());
}

/// Shells of the mesh that enclose something, then plates in the place of the others.
struct Thick {
  Mesh mesh;
  std::size_t first_of_plates = 0;  // triangle
  double sheet_area_m2 = 0;
};

Thick with_plates(const Mesh& mesh, const SolidChoice& choice) {
  if (choice.kind == SolidKind::closed) return {mesh, mesh.triangles.size(), 0};
  const MeshQuery all = winding_query(mesh);
  const double diagonal_m = mesh.bounds().diagonal().norm();
  Thick thick;
  Mesh plates;
  for (const Shell& shell : shells_of(mesh)) {
    const Mesh alone = mesh_of(mesh, shell);
    if (choice.kind == SolidKind::sheet || is_sheet(alone, all, diagonal_m)) {
      thick.sheet_area_m2 += surface_area_m2(alone);
      plates.append(thickened(alone, choice.thickness_m));
    } else {
      thick.mesh.append(alone);
    }
  }
  thick.first_of_plates = thick.mesh.triangles.size();
  thick.mesh.append(plates);
  return thick;
}

double area_of(const std::array<Vec3, 3>& t) {
  return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
}

/// Triangles by their corners' places; corners at the same place are one vertex.
class Pieces {
 public:
  void append(const std::array<Vec3, 3>& t) {
    std::array<std::uint32_t, 3> v{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [it, is_new] =
          vertex_at_.try_emplace({t[k].x(), t[k].y(), t[k].z()}, static_cast<std::uint32_t>(mesh_.vertices.size()));
      if (is_new) mesh_.vertices.push_back(t[k]);
      v[k] = it->second;
    }
    mesh_.triangles.push_back(v);
  }
  [[nodiscard]] Mesh take() { return std::move(mesh_); }

 private:
  Mesh mesh_;
  std::map<std::array<double, 3>, std::uint32_t> vertex_at_;
};

/// Closed, and nowhere inside itself, as far as a sample shows.
bool is_clean(const Mesh& mesh) {
  if (open_edges(mesh) > 0) return false;
  const MeshQuery query = winding_query(mesh);
  const double diagonal_m = mesh.bounds().diagonal().norm();
  const auto places = sample_by_area(mesh, kCleanPlaces, kSeed);
  std::vector<std::uint8_t> outer(places.size());
  for_each_index(places.size(), [&](std::size_t i) {
    const Vec3 n = query.triangle_normal(places[i].triangle);
    // Behind is asked, too: where a triangle has another one on its back, the number does not change.
    const bool air_before = winding_before(query, places[i].p, n, diagonal_m) < 0.5;
    outer[i] = air_before && winding_before(query, places[i].p, -n, diagonal_m) > 0.5 ? 1 : 0;
  });
  return std::find(outer.begin(), outer.end(), 0) == outer.end();
}

/// The outer surface of the shells and plates, and membranes over what is open.
void assemble(const Thick& thick, SolidMesh& solid) {
  if (is_clean(thick.mesh)) {
    solid.mesh = thick.mesh;
    solid.origin.assign(thick.first_of_plates, SurfaceOrigin::mesh);
    solid.origin.resize(thick.mesh.triangles.size(), SurfaceOrigin::sheet);
    return;
  }
  const MeshQuery query = winding_query(thick.mesh);
  const OuterSurface outer = outer_surface(thick.mesh, query);
  double shown_m2 = 0;
  Pieces pieces;
  for (std::size_t i = 0; i < outer.pieces.size(); ++i) {
    const SurfaceOrigin origin = i < thick.first_of_plates ? SurfaceOrigin::mesh : SurfaceOrigin::sheet;
    for (const auto& piece : outer.pieces[i]) {
      shown_m2 += area_of(piece);
      pieces.append(piece);
      solid.origin.push_back(origin);
    }
  }
  solid.hidden_area_m2 = std::max(0.0, surface_area_m2(thick.mesh) - shown_m2);
  const Mesh skin = membranes(thick.mesh, query, outer.cuts, thick.mesh.bounds().diagonal().norm() / kMembraneCells);
  solid.membrane_area_m2 = surface_area_m2(skin);
  solid.mesh = pieces.take();
  solid.mesh.append(skin);
  solid.origin.resize(solid.mesh.triangles.size(), SurfaceOrigin::membrane);
}

}  // namespace

std::optional<SolidChoice> solid_choice_of(std::string_view text) {
  constexpr std::string_view kSheet = "sheet";
  if (text == "auto") return SolidChoice{};
  SolidChoice choice;
  choice.kind = text == "closed" ? SolidKind::closed : SolidKind::sheet;
  if (text == "closed" || text == kSheet) return choice;
  if (!text.starts_with(kSheet) || text.size() < kSheet.size() + 2 || text[kSheet.size()] != ' ') return std::nullopt;
  const std::string_view number = text.substr(kSheet.size() + 1);
  const auto [end, code] = std::from_chars(number.data(), number.data() + number.size(), choice.thickness_m);
  const bool read = code == std::errc() && end == number.data() + number.size();
  if (!read || !(choice.thickness_m >= kLeastSheet_m && choice.thickness_m <= kMostSheet_m)) return std::nullopt;
  return choice;
}

std::string text_of(const SolidChoice& choice) {
  if (choice.kind == SolidKind::automatic) return "auto";
  if (choice.kind == SolidKind::closed) return "closed";
  std::array<char, 32> number{};
  const auto [end, code] = std::to_chars(number.data(), number.data() + number.size(), choice.thickness_m);
  return "sheet " + std::string(number.data(), end);
}

SolidMesh make_solid(const Mesh& welded, const SolidChoice& choice) {
  SolidMesh solid;
  solid.open_edges = open_edges(welded);
  Mesh mesh = welded;
  static_cast<void>(turn_outwards(mesh));
  if (choice.kind != SolidKind::sheet && is_clean(mesh)) {
    solid.turned = turned_triangles(welded, mesh);
    solid.origin.assign(mesh.triangles.size(), SurfaceOrigin::mesh);
    solid.mesh = std::move(mesh);
    return solid;
  }
  solid.doubled = drop_doubles(mesh);
  solid.turned = make_consistent(mesh) + turn_open_patches(mesh);
  static_cast<void>(turn_outwards(mesh));
  const Thick thick = with_plates(mesh, choice);
  solid.sheet_area_m2 = thick.sheet_area_m2;
  assemble(thick, solid);
  return solid;
}

}  // namespace mechane::geometry
