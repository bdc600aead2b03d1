#include "client-sdk/fit/summary_json.hpp"

#include <nlohmann/json.hpp>

#include "client-sdk/fit/table.hpp"

namespace mechane::fit {
namespace {

using Json = nlohmann::ordered_json;

Json part_json(const PartSummary& part, bool met) {
  return {{"name", printable(part.name)},
          {"triangles", part.triangles},
          {"axes_mm", {part.axes_mm.x(), part.axes_mm.y(), part.axes_mm.z()}},
          {"exponents", {part.e1, part.e2}},
          {"taper", {part.taper_x, part.taper_y}},
          {"bend_deg", part.bend_deg},
          {"fit_error_pct", {{"mean", part.fit_mean_pct}, {"rms", part.fit_rms_pct}, {"max", part.fit_max_pct}}},
          {"map", part.map_kind},
          {"map_bytes", part.map_bytes},
          {"depth_error_mm", {{"p50", part.depth_error_p50_mm}, {"p99", part.depth_error_p99_mm}}},
          {"samples", part.samples},
          {"spacing_mm", part.spacing_mm},
          {"met", met}};
}

}  // namespace

std::string summary_json(const FittedObject& fitted, const Summary& summary) {
  Json parts = Json::array();
  for (std::size_t i = 0; i < summary.parts.size(); ++i)
    parts.push_back(part_json(summary.parts[i], fitted.report.parts[i].met));
  Json settings;
  for (const auto& [name, value] : settings_of(fitted))
    settings[name] = value;
  const Json json = {{"mesh", printable(fitted.mesh_file.string())},
                     {"mesh_xxh3_128", fitted.mesh_hash},
                     {"triangles", summary.triangles},
                     {"diagonal_mm", summary.diagonal_mm},
                     {"map_bytes", summary.map_bytes},
                     {"file_bytes", summary.file_bytes},
                     {"build_s", summary.build_s},
                     {"felt_mm", {{"p50", summary.felt_p50_mm}, {"p99", summary.felt_p99_mm}}},
                     {"not_felt_share", summary.not_felt_share},
                     {"met", !summary.misses_budget},
                     {"notes", summary.notes},
                     {"settings", settings},
                     {"parts", parts}};
  // Notes contain names from the file, which need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace mechane::fit
