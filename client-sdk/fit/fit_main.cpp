// mechane-fit: makes meshes ready for touch, offline, and reports how true they feel.
#include <cstdio>
#include <exception>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "client-sdk/fit/fit_mesh.hpp"
#include "client-sdk/fit/interruption.hpp"
#include "client-sdk/fit/progress.hpp"
#include "client-sdk/fit/table.hpp"
#include "server/log/command_line.hpp"

namespace {

using namespace mechane;
namespace fs = std::filesystem;

struct Arguments {
  std::vector<std::string> meshes;
  fit::FitOptions options;
  std::string folder;
  std::string report = "html";
  bool from_nodes = false;
  bool cut_all = false;
  bool strict = false;
};

void add_options(CLI::App& app, Arguments& a) {
  collision_build::BuildConfig& config = a.options.config;
  app.add_option("MESH", a.meshes, "mesh files: .glb, .gltf, .obj, .stl, .ply, .x3d; in metres")->required();
  app.add_option("-o,--output", a.folder, "folder for the results, made when missing; without: beside each mesh");
  app.add_option("--scale", a.options.scale, "metres of one unit of the file: 0.001 for a model in millimetres")
      ->check(CLI::Range(1e-6, 1e6))
      ->capture_default_str();
  app.add_option("--node", a.options.node, "only what is under this node of the file");
  auto* from_nodes = app.add_flag("--part-from-nodes", a.from_nodes,
                                  "each node named part_... is a part, or else each node with a mesh; without any of "
                                  "these three options: the same if "
                                  "there are several nodes, while a single mesh is cut into parts");
  auto* cut_all = app.add_flag("--cut", a.cut_all,
                               "every mesh is cut into nearly convex parts, or gets a single map where that is smaller")
                      ->excludes(from_nodes);
  app.add_flag("--whole", a.options.whole, "all meshes together form one part")
      ->excludes(from_nodes)
      ->excludes(cut_all);
  app.add_option_function<std::string>(
         "--solid",
         [&config](const std::string& text) {
           const auto choice = geometry::solid_choice_of(text);
           if (!choice)
             throw CLI::ValidationError("--solid", "write auto, closed, or 'sheet 0.001': metres, 0.0001 to 0.1");
           config.solid = *choice;
         },
         "what is inside, where a mesh is open: closed closes its holes, 'sheet T' makes its surface T metres thick, "
         "auto "
         "closes what encloses something and makes a sheet of 1 mm of the rest")
      ->type_name("TEXT")
      ->default_str("auto");
  app.add_option("--concavity", config.max_concavity, "how hollow a part may be, as a share of its mesh's diagonal")
      ->check(CLI::Range(0.001, 1.0))
      ->capture_default_str();
  app.add_option("--max-parts", config.max_pieces, "the most parts into which a mesh is cut")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--error", config.max_error_m, "largest error of a part's map at 99 of 100 places, in metres")
      ->check(CLI::Range(1e-6, 1.0))
      ->capture_default_str();
  app.add_option("--error-share", config.max_error_share,
                 "the same as a share of the diagonal; the smaller of both counts")
      ->check(CLI::Range(1e-6, 0.1))
      ->capture_default_str();
  app.add_option_function<std::string>(
         "--map", [&config](const std::string& map) { config.fields = map == "field"; },
         "auto: radial maps and bricks; field: one field for each mesh, which is not cut then")
      ->check(CLI::IsMember({"auto", "field"}));
  app.add_option("--resolution", config.map_resolution,
                 "texels along an edge of a part's radial map; 0: the smallest map that is accurate enough")
      ->check(CLI::IsMember({0, 8, 12, 16, 24, 32, 48, 64}))
      ->capture_default_str();
  app.add_option("--spacing", config.sample_spacing_m, "metres between the samples that touch other bodies")
      ->check(CLI::Range(1e-4, 1.0))
      ->capture_default_str();
  app.add_option("--max-samples", config.max_samples_per_part,
                 "the most samples of a part; a larger part gets a wider spacing")
      ->check(CLI::Range(16, 1'000'000))
      ->capture_default_str();
  app.add_option("--seam-gap", config.seam_gap_m, "metres; gaps between parts up to this width are closed")
      ->check(CLI::Range(0.0, 0.1))
      ->capture_default_str();
  app.add_option("--seed", config.seed, "same mesh, settings and seed: same object, to the bit")->capture_default_str();
  app.add_option("--report", a.report, "write a page with pictures beside the object, or none")
      ->check(CLI::IsMember({"html", "none"}))
      ->capture_default_str();
  app.add_flag("--json", a.options.json, "also write the figures for programs, to MESH.json");
  app.add_flag("--strict", a.strict, "exit with status 3 if a part exceeds the allowed error; it is written anyway");
}

/// The mesh whose results would be overwritten, if another mesh has the same name and output folder; else `mesh`
/// itself.
std::string twin_of(const std::string& mesh, const fit::FitOptions& options, std::map<fs::path, std::string>& taken) {
  std::error_code code;
  const fs::path file = fs::absolute(fit::part_file_of(mesh, options), code).lexically_normal();
  return taken.try_emplace(file, mesh).first->second;
}

void say(const fit::FitResult& result, const std::string& mesh) {
  fmt::print("\n{}\n{}", fit::printable(mesh), fit::summary_table(result.summary));
  fmt::print("{}{}\n", fit::wrapped_text(fit::verdict(result.summary), "", ""), result.part_file.string());
  for (const fs::path& file : {result.report_file, result.json_file})
    if (!file.empty()) fmt::print("{}\n", file.string());
  std::fflush(stdout);
}

int run(const Arguments& a) {
  fit::Interruption interruption;
  fit::Progress progress(stderr);
  std::map<fs::path, std::string> taken;
  bool all_good = true;
  bool all_exact = true;
  for (const std::string& mesh : a.meshes) {
    const std::string twin = twin_of(mesh, a.options, taken);
    Expected<fit::FitResult> result = fail(ErrorCode::conflict, "its results would overwrite those of " + twin, mesh,
                                           "give one of them another name");
    if (twin == mesh) result = fit::fit_mesh(mesh, a.options, progress, interruption);
    progress.end();
    if (result) {
      say(*result, mesh);
      all_exact = all_exact && !result->summary.misses_budget;
    } else {
      fmt::print(stderr, "mechane fit: {}\n", fit::printable(result.error().to_string()));
      all_good = false;
    }
  }
  if (!all_good) return 1;
  return a.strict && !all_exact ? 3 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app{
      "Makes meshes ready for touch: superquadric parts with distance maps in MESH.part, how true they feel in "
      "MESH.html.",
      "mechane fit"};
  app.get_formatter()->column_width(34);
  add_options(app, a);
  if (const std::optional<int> status = parse_command_line(app, argc, argv)) return *status;
  a.options.folder = a.folder;
  a.options.report = a.report == "html";
  try {
    return run(a);
  } catch (const std::exception& e) {  // no memory, no thread
    fmt::print(stderr, "mechane fit: {}; close other programs, or simplify the meshes\n", e.what());
    return 1;
  }
}
