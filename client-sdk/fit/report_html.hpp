// The report of a fitted object as one HTML page: no network, no scripts, pictures inside.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client-sdk/fit/fitted_object.hpp"
#include "client-sdk/fit/map_image.hpp"
#include "client-sdk/fit/picture.hpp"
#include "client-sdk/fit/summary.hpp"

namespace mechane::fit {

/// All that the page shows.
struct Report {
  std::string title;
  std::string mesh_hash;
  std::string part_file;  ///< name without folder
  std::vector<std::pair<std::string, std::string>> settings;
  Summary summary;
  double reach_mm = 0;  ///< see Surface::reach_m
  std::vector<Colour> part_colours;
  Row parts;
  std::optional<Row> origins;  ///< where a mesh was open or had no inside
  ErrorRow errors;
  Row superquadrics;
  std::vector<std::size_t> mapped;  ///< parts whose maps are shown
  std::vector<MapPicture> maps;     ///< theirs
};

/// Draws and probes; takes seconds. Uses all cores.
[[nodiscard]] Report make_report(const FittedObject& fitted, const Surface& surface, const Summary& summary);

/// The self-contained page: about 3 MB at most, for up to a hundred parts.
[[nodiscard]] std::string html_page(const Report& report);

/// A file's text for use in a page: escapes markup, replaces control characters.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace mechane::fit
