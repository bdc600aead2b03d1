#include "client-sdk/fit/summary.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "server/base/parallel.hpp"
#include "server/geometry/mesh_check.hpp"
#include "server/geometry/surface_samples.hpp"

namespace mechane::fit {
namespace {

// A fingertip can feel steps of about a millimetre on a held shape; this is the target for the parts of a machine.
constexpr double kFeltAsRight_mm = 1.0;
constexpr std::size_t kPlaces = 6000;
constexpr double kMissedShare = 0.002;  // of the surface: if more is missing, a finger will find the hole
constexpr double kLargeObject_mm = 20'000;
constexpr double kSmallObject_mm = 10;

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

void note_meshes(const FittedObject& fitted, Summary& summary) {
  std::vector<std::string> open;
  for (const geometry::NamedMesh& part : fitted.meshes) {
    if (geometry::open_edges(part.mesh) > 0) open.push_back(part.name);
  }
  if (!open.empty()) {
    summary.notes.push_back(
        listed(open) +
        ": edges without a neighbour, so the mesh is open and felt from outside only; close it to make it solid");
  }
  if (!fitted.turned.empty()) {
    summary.notes.push_back(listed(fitted.turned) +
                            ": inside out in the model, built with its faces turned round; turn them in the model");
  }
}

void note_size(Summary& summary) {
  if (summary.diagonal_mm > kLargeObject_mm || summary.diagonal_mm < kSmallObject_mm) {
    summary.notes.push_back(
        fmt::format("the object measures {} mm from corner to corner; if that is not meant, export the model in "
                    "metres, or give --scale",
                    mm_text(summary.diagonal_mm)));
  }
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
      "{} of {} parts exceed the allowed error of {} mm: {}; each has the least error found", inexact.size(),
      fitted.report.parts.size(), mm_text(1000 * fitted.report.budget.depth_p99_m), listed(inexact)));
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
  s.triangles = surface.mesh().triangles.size();
  s.file_bytes = fitted.part_file_bytes;
  s.build_s = fitted.report.seconds;
  s.diagonal_mm = 1000 * surface.diagonal_m();
  measure_surface(surface, fitted.config.seed, s);
  note_size(s);
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
  return felt + " It will feel right.";
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
