#include "client-sdk/fit/summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "server/base/parallel.hpp"
#include "server/geometry/area_normal.hpp"
#include "server/geometry/surface_samples.hpp"

namespace mechane::fit {
namespace {

// A fingertip can feel steps of about a millimetre on a held shape; this is the target for the parts of a machine.
constexpr double kFeltAsRight_mm = 1.0;
constexpr std::size_t kPlaces = 6000;
constexpr double kMissedShare = 0.002;  // of the surface: if more is missing, a finger will find the hole
constexpr double kLargeObject_mm = 20'000;
constexpr double kSmallObject_mm = 10;
constexpr double kHandled_mm[] = {30, 3000};  // from corner to corner, of things that a museum shows
constexpr double kResting = 0.01;             // of the height: what lies below rests on the ground

struct Unit {
  const char* name;
  double metres;
};
constexpr Unit kUnits[] = {{"millimetres", 0.001}, {"centimetres", 0.01}, {"inches", 0.0254}, {"metres", 1}};

PartSummary part_summary(const collision::Part& part, const collision_build::PartReport& report,
                         std::size_t triangles) {
  PartSummary s;
  s.name = part.name;
  s.triangles = triangles;
  s.axes_mm = 1000 * part.superquadric.a;
  s.e1 = part.superquadric.e1;
  s.e2 = part.superquadric.e2;
  s.taper_x = part.superquadric.taper_x;
  s.taper_y = part.superquadric.taper_y;
  s.bend_deg = part.superquadric.bend_per_m * 2 * part.superquadric.a.z() * 180 / kPi;
  s.fit_mean_pct = report.fit.mean_pct;
  s.fit_rms_pct = report.fit.rms_pct;
  s.fit_max_pct = report.fit.max_pct;
  s.map_kind = report.map;
  s.map_bytes = report.bytes;
  s.depth_error_p50_mm = 1000 * report.error.p50_m;
  s.depth_error_p99_mm = 1000 * report.error.p99_m;
  s.samples = report.samples;
  s.spacing_mm = 1000 * report.spacing_m;
  return s;
}

/// "part 'a'", or "parts 'a', 'b' and 15 more".
std::string listed(const std::vector<std::string>& names) {
  if (names.size() == 1) return fmt::format("part '{}'", names.front());
  if (names.size() == 2) return fmt::format("parts '{}' and '{}'", names[0], names[1]);
  return fmt::format("parts '{}', '{}' and {} more", names[0], names[1], names.size() - 2);
}

/// What was decided of one mesh that was not a clean closed one.
void note_solid(const std::string& name, const geometry::SolidMesh& solid, const geometry::SolidChoice& choice,
                Summary& summary) {
  const auto note = [&](const std::string& text) { summary.notes.push_back(fmt::format("part '{}': {}", name, text)); };
  const double area_m2 = geometry::surface_area_m2(solid.mesh);
  if (solid.membrane_area_m2 > 0) {
    note(
        fmt::format("open, with {} edges without a neighbour; its holes are closed, by {:.2g} % of its surface; if it "
                    "is meant to be open, give --solid 'sheet 0.001'",
                    solid.open_edges, 100 * solid.membrane_area_m2 / area_m2));
  }
  if (solid.sheet_area_m2 > 0) {
    note(
        fmt::format("{} cm² of it enclose nothing and are made a sheet of {} mm; --solid gives another thickness, or "
                    "closes it",
                    mm_text(1e4 * solid.sheet_area_m2), mm_text(1000 * choice.thickness_m)));
  }
  if (solid.hidden_area_m2 > 0.001 * area_m2) {
    note(fmt::format("{} cm² of it lie inside other pieces or enclose nothing, and are left out",
                     mm_text(1e4 * solid.hidden_area_m2)));
  }
  if (solid.doubled > 0) note(fmt::format("{} triangles have a second one on their back, left out", solid.doubled));
  if (solid.turned > 0) note(fmt::format("{} triangles faced the wrong way and are turned", solid.turned));
}

void note_meshes(const FittedObject& fitted, Summary& summary) {
  for (std::size_t i = 0; i < fitted.meshes.size(); ++i)
    note_solid(fitted.meshes[i].name, fitted.report.solids[i], fitted.config.solid, summary);
  if (!fitted.turned.empty()) {
    summary.notes.push_back(listed(fitted.turned) +
                            ": inside out in the model, built with its faces turned round; turn them in the model");
  }
}

/// A thing that people handle, in the unit that programs most often export: metres are what it is taken for.
void note_size(const FittedObject& fitted, Summary& summary) {
  if (summary.diagonal_mm <= kLargeObject_mm && summary.diagonal_mm >= kSmallObject_mm) return;
  const auto guess = std::find_if(std::begin(kUnits), std::end(kUnits), [&](const Unit& unit) {
    const double diagonal_mm = summary.diagonal_mm * unit.metres / fitted.scale;
    return diagonal_mm >= kHandled_mm[0] && diagonal_mm <= kHandled_mm[1];
  });
  const std::string remedy =
      guess != std::end(kUnits)
          ? fmt::format("it was probably made in {}: give --scale {:g}", guess->name, guess->metres)
          : std::string("if that is not meant, export the model in metres, or give --scale");
  summary.notes.push_back(
      fmt::format("the object measures {} mm from corner to corner; {}", mm_text(summary.diagonal_mm), remedy));
}

/// The axis on whose lower end most of the surface rests; y where none does.
const char* up_axis_of(const geometry::Mesh& mesh) {
  const Eigen::AlignedBox3d box = mesh.bounds();
  Vec3 resting_m2 = Vec3::Zero();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vec3 down = -0.5 * geometry::area_normal(mesh, i);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      double highest = box.min()[axis];
      for (const std::uint32_t v : mesh.triangles[i])
        highest = std::max(highest, mesh.vertices[v][axis]);
      if (highest <= box.min()[axis] + kResting * box.sizes()[axis]) resting_m2[axis] += std::max(0.0, down[axis]);
    }
  }
  constexpr std::array<const char*, 3> kNames{"x", "y", "z"};
  Eigen::Index up = 1;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (resting_m2[axis] > 1.5 * resting_m2[up]) up = axis;
  }
  return kNames[static_cast<std::size_t>(up)];
}

/// glTF says which way is up; other formats do not.
void note_up_axis(const FittedObject& fitted, const Surface& surface, Summary& summary) {
  if (const auto kind = fitted.mesh_file.extension(); kind == ".glb" || kind == ".gltf") return;
  const std::string up = up_axis_of(surface.mesh());
  if (up == "y") return;
  summary.notes.push_back(
      fmt::format("it seems to stand along {}, while up is y in Mechane: turn it in the model, or by "
                  "the body's orientation",
                  up));
}

/// Reports parts that exceed the requested error.
void note_budget(const FittedObject& fitted, Summary& summary) {
  std::vector<std::string> inexact;
  for (const collision_build::PartReport& part : fitted.report.parts) {
    if (!part.met) inexact.push_back(part.name);
  }
  summary.misses_budget = !inexact.empty();
  if (inexact.empty()) return;
  summary.notes.push_back(fmt::format(
      "{} of {} parts exceed the allowed error of {} mm, or miss places: {}; each has the least error found",
      inexact.size(), fitted.report.parts.size(), mm_text(1000 * fitted.report.budget.depth_p99_m), listed(inexact)));
}

void note_parts(const FittedObject& fitted, Summary& summary) {
  std::vector<std::string> hidden;
  std::vector<std::string> sparse;
  double widest_mm = 0;
  for (const PartSummary& part : summary.parts) {
    if (part.samples == 0) {
      hidden.push_back(part.name);
    } else if (part.spacing_mm > 1.5 * 1000 * fitted.config.sample_spacing_m) {
      sparse.push_back(part.name);
      widest_mm = std::max(widest_mm, part.spacing_mm);
    }
  }
  if (!hidden.empty()) {
    summary.notes.push_back(
        listed(hidden) +
        ": entirely inside other parts, so it cannot be felt; if it is a node of the model, leave it out");
  }
  if (!sparse.empty()) {
    summary.widest_gap_mm = widest_mm;
    summary.notes.push_back(
        fmt::format("{}: large, so the samples lie up to {} mm apart, and a fingertip may slip between them; cut it, "
                    "or raise --max-samples",
                    listed(sparse), mm_text(widest_mm)));
  }
}

/// Measures the whole surface, at evenly spread places.
void measure_surface(const Surface& surface, std::uint64_t seed, Summary& summary) {
  const auto places = geometry::sample_by_area(surface.mesh(), kPlaces, seed + 3);
  std::vector<std::optional<SurfaceError>> asked(places.size());
  for_each_index(places.size(), [&](std::size_t i) { asked[i] = surface.error_at(places[i].p, places[i].triangle); });
  std::vector<double> errors_mm;
  std::size_t not_felt = 0;
  for (const auto& error : asked) {
    if (!error) continue;
    errors_mm.push_back(1000 * (error->felt ? error->error_m : surface.reach_m()));
    not_felt += error->felt ? 0 : 1;
  }
  if (errors_mm.empty()) return;
  std::sort(errors_mm.begin(), errors_mm.end());
  summary.felt_p50_mm = errors_mm[errors_mm.size() / 2];
  summary.felt_p99_mm = errors_mm[errors_mm.size() * 99 / 100];
  summary.not_felt_share = static_cast<double>(not_felt) / static_cast<double>(errors_mm.size());
}

}  // namespace

Summary summarise(const FittedObject& fitted, const Surface& surface) {
  Summary s;
  const std::vector<std::size_t> triangles = surface.triangles_of_parts();
  for (std::size_t i = 0; i < fitted.object.parts.size(); ++i) {
    s.parts.push_back(part_summary(fitted.object.parts[i], fitted.report.parts[i], triangles[i]));
    s.samples += s.parts.back().samples;
    s.map_bytes += s.parts.back().map_bytes;
    if (s.parts.back().depth_error_p99_mm > s.parts[s.worst_part].depth_error_p99_mm) s.worst_part = i;
  }
  for (const geometry::NamedMesh& mesh : fitted.meshes)
    s.triangles += mesh.mesh.triangles.size();
  s.file_bytes = fitted.part_file_bytes;
  s.build_s = fitted.report.seconds;
  s.diagonal_mm = 1000 * surface.diagonal_m();
  measure_surface(surface, fitted.config.seed, s);
  note_size(fitted, s);
  note_up_axis(fitted, surface, s);
  note_meshes(fitted, s);
  note_parts(fitted, s);
  note_budget(fitted, s);
  return s;
}

std::string verdict(const Summary& summary) {
  const char* remedy = summary.misses_budget
                           ? "cut the parts where they are hollow, forked or hooked, or lower --concavity."
                           : "cut the parts where they are hollow, forked or hooked, or lower --error and --concavity.";
  if (summary.not_felt_share > kMissedShare) {
    return fmt::format("{:.1f} % of this surface is not felt at all: a finger goes through it. To mend it, {}",
                       100 * summary.not_felt_share, remedy);
  }
  const std::string felt =
      fmt::format("A finger feels this surface within {} mm at 99 of 100 places.", mm_text(summary.felt_p99_mm));
  if (summary.felt_p99_mm > kFeltAsRight_mm)
    return felt + fmt::format(" Beyond {:.0f} mm edges feel rounded and flats wavy: {}", kFeltAsRight_mm, remedy);
  if (summary.widest_gap_mm > 0) {
    return felt + fmt::format(
                      " But a fingertip may slip between samples that lie up to {} mm apart: cut the large parts, "
                      "or raise --max-samples.",
                      mm_text(summary.widest_gap_mm));
  }
  const double missed_pct = 100 * summary.not_felt_share;
  if (missed_pct < 0.005) return felt + " It will feel right.";
  return felt +
         fmt::format(" It will feel right: the {:.2f} % that is not felt is too little to be noticed.", missed_pct);
}

std::vector<std::pair<std::string, std::string>> settings_of(const FittedObject& fitted) {
  const collision_build::BuildConfig& config = fitted.config;
  const std::string resolution =
      config.map_resolution == 0 ? "the smallest sufficient" : fmt::format("{} texels per edge", config.map_resolution);
  return {{"metres of a unit (--scale)", fmt::format("{:g}", fitted.scale)},
          {"error allowed (--error)", fmt::format("{} mm", mm_text(1000 * config.max_error_m))},
          {"error allowed (--error-share)", fmt::format("{:g} % of the diagonal", 100 * config.max_error_share)},
          {"hollowness of a part (--concavity)", fmt::format("{:g} % of the diagonal", 100 * config.max_concavity)},
          {"parts of a mesh at most (--max-parts)", fmt::format("{}", config.max_pieces)},
          {"kind of map (--map)", config.fields ? "field" : "auto"},
          {"map resolution (--resolution)", resolution},
          {"sample spacing (--spacing)", fmt::format("{} mm", mm_text(1000 * config.sample_spacing_m))},
          {"samples a piece at most (--max-samples)", fmt::format("{}", config.max_samples_per_part)},
          {"inside (--solid)", geometry::text_of(config.solid)},
          {"seam gap (--seam-gap)", fmt::format("{} mm", mm_text(1000 * config.seam_gap_m))},
          {"seed (--seed)", fmt::format("{}", config.seed)}};
}

std::string bytes_text(std::size_t bytes) {
  const auto size = static_cast<double>(bytes);
  if (bytes < 1000) return fmt::format("{} B", bytes);
  if (bytes < 1'000'000) return fmt::format("{:.1f} KB", size / 1e3);
  return fmt::format("{:.1f} MB", size / 1e6);
}

std::string mm_text(double mm) {
  if (!std::isfinite(mm)) return "?";  // not measured
  if (mm == 0) return "0";
  if (std::abs(mm) < 0.001) return "0.000";
  const int before = static_cast<int>(std::floor(std::log10(std::abs(mm))));
  return fmt::format("{:.{}f}", mm, std::clamp(1 - before, 0, 3));
}

}  // namespace mechane::fit
