#include "server/content/mesh_import.hpp"

#include <csignal>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>
#include <unistd.h>

#include "server/base/program_folder.hpp"
#include "server/content/child_process.hpp"
#include "server/content/scene_codec.hpp"

namespace mechane::content {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "mechane-mesh-import";
constexpr const char* kTryAnother = "open the file in a modelling program and export it again, best as .glb";

Expected<fs::path> find_helper(const ImportLimits& limits) {
  if (!limits.helper.empty()) return limits.helper;
  std::vector<fs::path> places;
  if (const char* folder = std::getenv("MECHANE_LIBEXEC"); folder != nullptr && *folder != '\0')
    places.emplace_back(folder);
  const fs::path own = program_folder();
  if (!own.empty()) places.insert(places.end(), {own, own / "../libexec/mechane"});
  for (const fs::path& place : places) {
    const fs::path program = place / kProgram;
    if (access(program.c_str(), X_OK) == 0) return program;
  }
  return fail(ErrorCode::not_found, fmt::format("the program {} was not found", kProgram), own.string(),
              "install Mechane in full, or name the program's folder in MECHANE_LIBEXEC");
}

Expected<void> check_file(const fs::path& file, const ImportLimits& limits) {
  std::error_code code;
  const fs::file_status status = fs::status(file, code);
  if (!fs::exists(status))
    return fail(ErrorCode::not_found, "the file does not exist", file.string(), "check the path");
  if (!fs::is_regular_file(status)) {
    return fail(ErrorCode::invalid_value, "this is a folder or a device, not a file", file.string(),
                "name a mesh file: .glb, .gltf, .obj, .stl, .ply or .x3d");
  }
  const std::uintmax_t size = fs::file_size(file, code);
  if (code) return fail(ErrorCode::io_failure, code.message(), file.string(), "check the file's rights");
  if (size == 0) return fail(ErrorCode::damaged, "the file is empty", file.string(), "export it again");
  if (size > limits.file_bytes) {
    return fail(ErrorCode::too_large,
                fmt::format("the file has {} bytes; the limit is {} bytes", size, limits.file_bytes), file.string(),
                "simplify the model");
  }
  if (access(file.c_str(), R_OK) != 0)
    return fail(ErrorCode::io_failure, std::strerror(errno), file.string(), "let the server's user read it");
  return {};
}

std::vector<std::string> arguments_for(const fs::path& file, const ImportLimits& limits) {
  return {fmt::format("--memory-bytes={}", limits.memory_bytes),
          fmt::format("--cpu-seconds={}", limits.cpu_seconds),
          fmt::format("--file-bytes={}", limits.file_bytes),
          fmt::format("--nodes={}", limits.nodes),
          fmt::format("--meshes={}", limits.meshes),
          fmt::format("--materials={}", limits.materials),
          fmt::format("--textures={}", limits.textures),
          fmt::format("--vertices={}", limits.vertices),
          fmt::format("--triangles={}", limits.triangles),
          fmt::format("--texture-bytes={}", limits.texture_bytes),
          fmt::format("--largest-m={}", limits.largest_m),
          fmt::format("--smallest-m={}", limits.smallest_m),
          "--",
          fs::absolute(file).string()};
}

/// The error of a child that ended without a message.
tl::unexpected<Error> bad_end(const ChildResult& child, const fs::path& file, const ImportLimits& limits) {
  const std::string where = file.string();
  switch (child.end) {
    case ChildResult::End::timed_out:
      return fail(ErrorCode::timed_out, fmt::format("reading it took more than {} ms", limits.wall_time.count()), where,
                  "simplify the model, or try again on a free machine");
    case ChildResult::End::too_long:
      return fail(ErrorCode::too_large, "what it contains is over the limits", where, "simplify the model");
    case ChildResult::End::signalled:
      if (child.code == SIGXCPU || (child.code == SIGKILL && child.output.empty())) {
        return fail(child.code == SIGXCPU ? ErrorCode::timed_out : ErrorCode::too_large,
                    fmt::format("reading it took more than {} s of processor time, or more memory than the machine has",
                                limits.cpu_seconds),
                    where, "simplify the model");
      }
      return fail(ErrorCode::failed_process,
                  fmt::format("the import crashed while reading it (signal {}, {})", child.code, strsignal(child.code)),
                  where, kTryAnother);
    case ChildResult::End::exited:
      break;
  }
  return fail(ErrorCode::failed_process, fmt::format("the import ended without a result (status {})", child.code),
              where, kTryAnother);
}

}  // namespace

Expected<ImportedScene> import_mesh(const fs::path& file, const ImportLimits& limits, const std::stop_token& stop) {
  if (auto good = check_file(file, limits); !good) return tl::unexpected<Error>(good.error());
  const Expected<fs::path> helper = find_helper(limits);
  if (!helper) return tl::unexpected<Error>(helper.error());
  const Expected<ChildResult> child =
      run_child(*helper, arguments_for(file, limits), limits.wall_time, longest_message(limits), stop);
  if (!child) return tl::unexpected<Error>(child.error());
  if (stop.stop_requested())
    return fail(ErrorCode::cancelled, "the import was stopped", file.string(), "import the file again");
  if (child->end != ChildResult::End::exited || child->output.empty()) return bad_end(*child, file, limits);
  Expected<ImportedScene> scene = decode_scene(child->output, limits);
  if (!scene) return tl::unexpected(scene.error().in(file.string()));
  return scene;
}

}  // namespace mechane::content
