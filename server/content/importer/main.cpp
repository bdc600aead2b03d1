// mechane-mesh-import: reads one mesh file and writes it to standard output in the form of scene_codec.hpp. import_mesh starts it, so that
// a foreign file that crashes the reader crashes only this process.
#include <cstdio>
#include <exception>
#include <new>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "server/base/utf8.hpp"
#include "server/base/whole_file.hpp"
#include "server/content/importer/assimp_reader.hpp"
#include "server/content/importer/confinement.hpp"
#include "server/content/importer/x3d_reader.hpp"
#include "server/content/scene_check.hpp"
#include "server/content/scene_codec.hpp"

namespace mechane::content {
namespace {

Expected<ImportedScene> read_checked(const std::filesystem::path& file, const ImportLimits& limits) {
  try {
    const bool x3d = lower_case(file.extension().string()) == ".x3d";
    Expected<ImportedScene> scene = x3d ? read_x3d(file, limits) : read_with_assimp(file, limits);
    if (!scene) return scene;
    if (auto good = check_scene(*scene, limits); !good) return tl::unexpected<Error>(good.error());
    return scene;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::too_large,
                fmt::format("reading it takes more than {} MiB of memory", limits.memory_bytes >> 20U), {},
                "simplify the model");
  } catch (const std::exception& e) {
    return fail(ErrorCode::damaged, fmt::format("the model cannot be read: {}", e.what()), {},
                "open the file in a modelling program and export it again, best as .glb");
  }
}

int run(int argc, char** argv) {
  ImportLimits limits;
  std::filesystem::path file;
  CLI::App app{"Reads a mesh file for Mechane; its output is for programs. See server/content/scene_codec.hpp."};
  app.add_option("--memory-bytes", limits.memory_bytes);
  app.add_option("--cpu-seconds", limits.cpu_seconds);
  app.add_option("--file-bytes", limits.file_bytes);
  app.add_option("--nodes", limits.nodes);
  app.add_option("--meshes", limits.meshes);
  app.add_option("--materials", limits.materials);
  app.add_option("--textures", limits.textures);
  app.add_option("--vertices", limits.vertices);
  app.add_option("--triangles", limits.triangles);
  app.add_option("--texture-bytes", limits.texture_bytes);
  app.add_option("--largest-m", limits.largest_m);
  app.add_option("--smallest-m", limits.smallest_m);
  app.add_option("file", file)->required();
  CLI11_PARSE(app, argc, argv);
  if (isatty(STDOUT_FILENO) != 0) {
    std::fputs("mechane-mesh-import: the output is binary; redirect it\n", stderr);
    return 2;
  }
  // What a library prints goes to stderr: it must not get between the bytes of the result.
  const int result = dup(STDOUT_FILENO);
  if (result < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) return 2;
  if (!confine_this_process(limits.memory_bytes, limits.cpu_seconds)) {
    std::fputs("mechane-mesh-import: this system refuses to limit what the import may do\n", stderr);
    return 3;
  }
  const Expected<ImportedScene> scene = read_checked(std::filesystem::absolute(file), limits);
  const std::vector<std::byte> message = scene ? encode_scene(*scene) : encode_failure(scene.error());
  return write_all(result, message) == 0 ? 0 : 4;
}

}  // namespace
}  // namespace mechane::content

int main(int argc, char** argv) {
  return mechane::content::run(argc, argv);
}
