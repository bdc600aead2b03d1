// One mesh file into one .part file and its report.
#pragma once

#include <filesystem>
#include <string>

#include "client-sdk/fit/fitted_object.hpp"
#include "client-sdk/fit/interruption.hpp"
#include "client-sdk/fit/progress.hpp"
#include "client-sdk/fit/summary.hpp"
#include "server/base/error.hpp"

namespace mechane::fit {

struct FitOptions {
  collision_build::BuildConfig config;
  std::filesystem::path folder;  ///< for the results; empty: beside the mesh
  std::string node;              ///< only what is under this node of the file; empty: all
  bool whole = false;            ///< all meshes form one part, whatever the file's nodes
  double scale = 1;              ///< metres per unit of the file
  bool report = true;            ///< also write the page
  bool json = false;             ///< also write the summary for programs
};

struct FitResult {
  Summary summary;
  std::filesystem::path part_file;
  std::filesystem::path report_file;  ///< empty: not requested
  std::filesystem::path json_file;    ///< empty: not requested
};

/// Where the object of a mesh is written: that of "screw.glb" to "screw.part", that of its node HANDLE to
/// "screw-HANDLE.part".
[[nodiscard]] std::filesystem::path part_file_of(const std::filesystem::path& mesh_file, const FitOptions& options);

/// Imports, builds, writes, reads back, compares, reports. Blocks for seconds to minutes; uses all cores. Errors name
/// the file and the part; neither file has then been changed, unless only the report could not be written.
[[nodiscard]] Expected<FitResult> fit_mesh(const std::filesystem::path& mesh_file, const FitOptions& options,
                                           Progress& progress, Interruption& interruption);

}  // namespace mechane::fit
