#include "client-sdk/fit/report_html.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "client-sdk/fit/report_style.hpp"
#include "client-sdk/fit/table.hpp"
#include "server/base/markup.hpp"
#include "server/base/parallel.hpp"

namespace mechane::fit {
namespace {

constexpr int kRowWidth = 1560;  // pixels of a row of three pictures; shown at two thirds of that
constexpr int kRowHeight = 540;
constexpr double kShown = 0.667;
constexpr std::size_t kPictureBytes = 2'000'000;  // of all rows: a third more as text, and maps and words beside
constexpr int kMapTexels = 32;
constexpr std::size_t kLegendParts = 30;
constexpr std::size_t kMostMaps = 40;
constexpr std::size_t kFewMaps = 4;

std::size_t picture_bytes(const Report& report) {
  std::size_t bytes = 0;
  for (const Row* row : {&report.parts, &report.errors.images, &report.superquadrics}) {
    for (const Image& image : *row)
      bytes += encode_png(image).size();
  }
  if (!report.origins) return bytes;
  for (const Image& image : *report.origins)
    bytes += encode_png(image).size();
  return bytes;
}

std::string picture(const Image& image, const std::string& alternative, bool sized) {
  const std::string size =
      sized ? fmt::format(" width=\"{:.0f}\" height=\"{:.0f}\"", image.width * kShown, image.height * kShown) : "";
  return fmt::format("<img{} alt=\"{}\" src=\"data:image/png;base64,{}\">", size, alternative,
                     base64(encode_png(image)));
}

std::string row_of(const Row& row, const char* what) {
  std::string out = "<div class=\"row\">";
  for (std::size_t i = 0; i < kSides; ++i) {
    out += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                       picture(row[i], fmt::format("{}, {}", what, kSideNames[i]), true), kSideNames[i]);
  }
  return out + "</div>\n";
}

std::string dot(const Colour& colour) {
  return fmt::format("<span class=\"dot\" style=\"background:{}\"></span>", css(colour));
}

std::string bar(Scale scale, const std::string& from, const std::string& to) {
  return fmt::format("<span>{}</span><i style=\"background:{}\"></i><span>{}</span>", from, css_gradient(scale), to);
}

std::string key_figures(const Summary& s) {
  const std::pair<const char*, std::string> figures[] = {
      {"parts", fmt::format("{}", s.parts.size())},
      {"felt within, 99 of 100 places", mm_text(s.felt_p99_mm) + " mm"},
      {"not felt at all", fmt::format("{:.2f} %", 100 * s.not_felt_share)},
      {"maps in memory", bytes_text(s.map_bytes)},
      {"triangles of the mesh", fmt::format("{}", s.triangles)},
      {"time to build", fmt::format("{:.1f} s", s.build_s)}};
  std::string out = "<dl class=\"key\">";
  for (const auto& [name, value] : figures)
    out += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", name, value);
  return out + "</dl>\n";
}

std::string parts_section(const Report& report) {
  std::string out =
      "<h2>Its parts</h2>\n<p class=\"lead\">A collision part has one superquadric and one map: a nearly convex piece, "
      "or a "
      "whole mesh if one map can represent it. Neighbouring parts have different colours, the same on the whole "
      "page.</p>\n";
  out += row_of(report.parts, "the object in the colours of its parts") + "<ul class=\"legend\">";
  if (report.summary.parts.size() > kLegendParts) {
    return out + fmt::format("<li>{} parts: the table below has their names and colours</li></ul>\n",
                             report.summary.parts.size());
  }
  for (std::size_t i = 0; i < report.summary.parts.size(); ++i)
    out += fmt::format("<li>{}{}</li>", dot(report.part_colours[i]), escaped(report.summary.parts[i].name));
  return out + "</ul>\n";
}

std::string origin_section(const Report& report) {
  if (!report.origins) return "";
  using geometry::SurfaceOrigin;
  return "<h2>What was closed</h2>\n<p class=\"lead\">The model is open somewhere, or has no inside. Holes were closed "
         "where the "
         "surface surrounds more than half of the view (generalized winding number), and surfaces that enclose nothing "
         "were given a thickness. <code>--solid</code> decides otherwise.</p>\n" +
         row_of(*report.origins, "the object in the colours of what was closed") + "<ul class=\"legend\"><li>" +
         dot(origin_colour(SurfaceOrigin::mesh)) + "the model's own surface</li><li>" +
         dot(origin_colour(SurfaceOrigin::membrane)) + "over a hole</li><li>" +
         dot(origin_colour(SurfaceOrigin::sheet)) + "a sheet's two sides</li></ul>\n";
}

std::string error_section(const Report& report) {
  std::string out = fmt::format(
      "<h2>How true it feels</h2>\n<p class=\"lead\">At each visible place the finished maps are asked where a finger "
      "that "
      "comes straight at the surface meets it. The colour is the distance from there to the true surface. Half "
      "of the "
      "surface is felt within {} mm. The search goes {} mm each way, in thin walls and narrow gaps to their "
      "middle.</p>\n",
      mm_text(report.summary.felt_p50_mm), mm_text(report.reach_mm));
  out += row_of(report.errors.images, "the object in the colours of its error");
  out += "<div class=\"bar\">" + bar(Scale::error, "0", mm_text(report.errors.scale_mm) + " mm and more");
  return out + fmt::format("<span>{}not felt at all: {:.2f} % of the surface</span></div>\n", dot(not_felt_colour()),
                           100 * report.summary.not_felt_share);
}

/// Writes the command's flags as code, so that lines do not break at their hyphens.
std::string with_flags(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t flag = std::min(text.find("--", at), text.size());
    const std::size_t end = std::min(text.find_first_not_of("-abcdefghijklmnopqrstuvwxyz", flag), text.size());
    out += text.substr(at, flag - at);
    if (flag < end) out += "<code>" + text.substr(flag, end - flag) + "</code>";
    at = end;
  }
  return out;
}

std::string superquadric_section(const Report& report) {
  return "<h2>The superquadrics over it</h2>\n<p class=\"lead\">Each part lies wholly within one smooth body, its "
         "superquadric: eleven "
         "numbers, or fifteen with taper and bend. It tells in a moment that a finger is not near, and carries the "
         "map. Where the "
         "glass hugs the object, the fit is close.</p>\n" +
         row_of(report.superquadrics, "the object under its superquadrics");
}

std::string map_card(const Report& report, std::size_t i) {
  const MapPicture& map = report.maps[i];
  const std::size_t part = report.mapped[i];
  const std::string name = escaped(report.summary.parts[part].name);
  std::string out = fmt::format(
      "<figure><b title=\"{}\">{}{}</b>{}<div class=\"bar\">{}</div>", name, dot(report.part_colours[part]), name,
      picture(map.image, "distance map of " + name, false), bar(Scale::depth, "0", mm_text(map.deepest_mm) + " mm"));
  if (map.no_hit_share >= 0.001 || map.covered_share >= 0.001) {
    out += "<figcaption>";
    if (map.no_hit_share >= 0.001) out += fmt::format("no hit {:.1f}&nbsp;% ", 100 * map.no_hit_share);
    if (map.covered_share >= 0.001) out += fmt::format("covered {:.1f}&nbsp;%", 100 * map.covered_share);
    out += "</figcaption>";
  }
  return out + "</figure>\n";
}

std::string map_section(const Report& report) {
  std::string out =
      "<h2>The distance maps</h2>\n<p class=\"lead\">Each part's superquadric unrolled like a box: its sides +x, +y, "
      "−x, −y from left to "
      "right, its top +z above, its bottom −z below. The colour is how far under the superquadric the felt surface "
      "lies, straight in. "
      "Dotted: no hit, the ray meets nothing of this part. Grey: covered, the ray starts inside the object already. "
      "Each map has a "
      "scale of its own.";
  if (report.maps.size() < report.summary.parts.size()) {
    out += fmt::format(" Of {} parts, here are the {} with the greatest depth error.", report.summary.parts.size(),
                       report.maps.size());
  }
  out += fmt::format("</p>\n<div class=\"maps{}\">\n", report.maps.size() <= kFewMaps ? " few" : "");
  for (std::size_t i = 0; i < report.maps.size(); ++i)
    out += map_card(report, i);
  return out + "</div>\n";
}

bool was_closed(const Surface& surface) {
  const auto& origin = surface.origin_of_triangle();
  return std::any_of(origin.begin(), origin.end(),
                     [](geometry::SurfaceOrigin o) { return o != geometry::SurfaceOrigin::mesh; });
}

/// The parts whose maps are drawn: all, or the worst.
std::vector<std::size_t> parts_to_map(const Summary& summary) {
  std::vector<std::size_t> all(summary.parts.size());
  std::iota(all.begin(), all.end(), 0);
  if (all.size() <= kMostMaps) return all;
  std::stable_sort(all.begin(), all.end(), [&](std::size_t a, std::size_t b) {
    return summary.parts[a].depth_error_p99_mm > summary.parts[b].depth_error_p99_mm;
  });
  all.resize(kMostMaps);
  return all;
}

std::string deformation(const PartSummary& p) {
  std::string text;
  if (p.taper_x != 0 || p.taper_y != 0) text = fmt::format("{:.2f}, {:.2f}", p.taper_x, p.taper_y);
  if (std::abs(p.bend_deg) >= 0.5) text += fmt::format("{}{:.0f}°", text.empty() ? "" : "; ", p.bend_deg);
  return text.empty() ? "–" : text;
}

std::string table_section(const Report& report) {
  std::string out =
      "<h2>Part by part</h2>\n<div class=\"scroll\"><table><thead><tr><th>part</th><th>triangles</th>"
      "<th>semi-axes<br>mm</th><th>exponents<br>e1, e2</th><th>taper;<br>bend</th><th>fit mean, RMS,<br>max %</th>"
      "<th>map</th><th>depth error<br>p50, p99 mm</th><th>samples</th></tr></thead><tbody>\n";
  for (std::size_t i = 0; i < report.summary.parts.size(); ++i) {
    const PartSummary& p = report.summary.parts[i];
    const bool worst = i == report.summary.worst_part && report.summary.parts.size() > 1;
    out += fmt::format(
        "<tr{}><td title=\"{}\">{}{}</td><td>{}</td><td>{} × {} × {}</td><td>{:.2f}, {:.2f}</td><td>{}</td>"
        "<td>{:.2f}, {:.2f}, {:.1f}</td><td>{}, {}</td><td>{}, {}</td><td>{}</td></tr>\n",
        worst ? " class=\"worst\"" : "", escaped(p.name), dot(report.part_colours[i]), escaped(p.name), p.triangles,
        mm_text(p.axes_mm.x()), mm_text(p.axes_mm.y()), mm_text(p.axes_mm.z()), p.e1, p.e2, deformation(p),
        p.fit_mean_pct, p.fit_rms_pct, p.fit_max_pct, escaped(p.map_kind), bytes_text(p.map_bytes),
        mm_text(p.depth_error_p50_mm), mm_text(p.depth_error_p99_mm), p.samples);
  }
  return out + "</tbody></table></div>\n";
}

std::string reading_section() {
  return "<h2>How to read the figures</h2>\n<div class=\"two\">"
         "<p><b>Depth error</b> is what a hand notices. The builder puts probes up to 4 mm under the surface of each "
         "part; p50 is the "
         "error that half of them keep within, p99 all but one in a hundred. Up to about 1 mm a shape feels right. "
         "<b>Felt within</b> is asked of the whole object instead: how far from its surface a finger that comes from "
         "outside meets it, where parts overlap the first of them.</p>"
         "<p><b>Fit error</b> is how far the superquadric alone is from the part, in % of the part's diagonal. It "
         "costs no "
         "truth, for the map holds the rest; a close fit makes queries quick and maps fine.</p>"
         "<p><b>Exponents</b>: 0.1 is boxy, 1 is round, 1.9 nearly a double cone; e1 along the axis z, e2 around "
         "it.</p>"
         "<p><b>Taper</b> narrows a part along its axis (x, y; 0.5 is half as wide in the middle's measure at the "
         "end); "
         "<b>bend</b> is its turn from end to end.</p>"
         "<p><b>Samples</b> are the points of this object that touch others. A fingertip must not fit between them.</p>"
         "<p><b>When a part is off:</b> cut it where it is hollow, forked or hooked, naming the pieces part_… in the "
         "model; "
         "or lower --error and --concavity. A hole or a thread is one part only where its "
         "map is made of bricks.</p></div>\n";
}

std::string settings_section(const Report& report) {
  std::string out = "<h2>Made from</h2>\n<table class=\"plain\">";
  const auto line = [&](const std::string& name, const std::string& value) {
    out += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", name, escaped(value));
  };
  line("mesh", report.title);
  line("mesh content (XXH3-128)", report.mesh_hash);
  line("object file", fmt::format("{}, {}", report.part_file, bytes_text(report.summary.file_bytes)));
  for (const auto& [name, value] : report.settings)
    line(name, value);
  return out + "</table>\n";
}

}  // namespace

Report make_report(const FittedObject& fitted, const Surface& surface, const Summary& summary) {
  Report report;
  report.title = fitted.mesh_file.filename().string() + (fitted.node.empty() ? "" : ", " + fitted.node);
  report.mesh_hash = fitted.mesh_hash;
  report.part_file = fitted.part_file.filename().string();
  report.settings = settings_of(fitted);
  report.summary = summary;
  report.reach_mm = 1000 * surface.reach_m();
  report.part_colours = part_colours(fitted.object);
  // A picture with much detail is a large file, so it gets fewer pixels.
  for (const double scale : {1.0, 0.75, 0.5625, 0.42}) {
    const Pictures pictures(surface, fitted.object, static_cast<int>(scale * kRowWidth),
                            static_cast<int>(scale * kRowHeight));
    report.parts = pictures.parts();
    if (was_closed(surface)) report.origins = pictures.origins();
    report.errors = pictures.errors();
    report.superquadrics = pictures.superquadrics();
    if (picture_bytes(report) <= kPictureBytes) break;
  }
  report.mapped = parts_to_map(summary);
  report.maps.resize(report.mapped.size());
  for_each_index(report.maps.size(),
                 [&](std::size_t i) { report.maps[i] = draw_map(fitted.object, report.mapped[i], kMapTexels); });
  return report;
}

std::string html_page(const Report& report) {
  const std::string title = escaped(report.title);
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
      "'unsafe-inline'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><meta name=\"color-scheme\" "
      "content=\"light dark\">\n"
      "<title>{} - how it feels</title><style>{}</style></head>\n<body><main>\n",
      title, kReportStyle);
  page +=
      fmt::format("<div class=\"kicker\">Mechane · collision object</div><h1>{}</h1>\n<p class=\"verdict\">{}</p>\n",
                  title, with_flags(escaped(verdict(report.summary))));
  page += key_figures(report.summary);
  if (!report.summary.notes.empty()) {
    page += "<ul class=\"notes\">";
    for (const std::string& note : report.summary.notes)
      page += fmt::format("<li>{}</li>", with_flags(escaped(note)));
    page += "</ul>\n";
  }
  page += parts_section(report) + origin_section(report) + error_section(report) + superquadric_section(report) +
          map_section(report);
  page += table_section(report) + reading_section() + settings_section(report);
  page += fmt::format(
      "<footer>Made by mechane fit {}. Same mesh, same settings and same version: same object, to the bit.</footer>\n",
      MECHANE_VERSION);
  return page + "</main></body></html>\n";
}

std::string escaped(std::string_view text) {
  return escape_markup(printable(text));  // printable also makes it UTF-8 without control characters
}

}  // namespace mechane::fit
