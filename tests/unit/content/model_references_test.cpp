// The other files that a model needs, in all forms in which its file can name them.
#include "server/content/model_references.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/error_like.hpp"
#include "tests/unit/content/catalogue_files.hpp"
#include "tests/unit/content/model_files.hpp"

namespace mechane::content {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ModelReferences, OfAGltfAreItsBuffersAndImages) {
  const ScratchFolder folder;
  const std::string json = R"({"asset":{"version":"2.0"},"buffers":[{"uri":"a%20b.bin"},{"byteLength":4}],
"images":[{"uri":"maps/oak.png"},{"uri":"data:image/png;base64,AAAA"},{"bufferView":0},{"uri":"https://example.org/x.png"},
{"uri":"/etc/passwd"},{"uri":7},7]})";
  EXPECT_THAT(*files_of_model(folder.write("a.gltf", json)), ElementsAre("a b.bin", "maps/oak.png"));
  EXPECT_THAT(*files_of_model(folder.write("a.glb", glb(json, "1234"))), ElementsAre("a b.bin", "maps/oak.png"));
  EXPECT_THAT(*files_of_model(folder.write("whole.glb", cube_glb())), IsEmpty());
}

TEST(ModelReferences, OfAnObjAreItsLibrariesAndTheirImages) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder.path() / "lib");
  folder.write(
      "lib/a.mtl",
      "newmtl a\nmap_Kd -s 1 1 1 -clamp on old oak.png\r\nmap_Bump -bm 0.4 bump.png\nKd 1 1 1\nnorm n.png\nmap_Ks\n");
  folder.write("with blank.mtl", "map_Kd c.png\n");
  const auto file =
      folder.write("a.obj", "# mtllib not.mtl\n mtllib lib/a.mtl gone.mtl\nmtllib with blank.mtl\nv 0 0 0\nusemtl a\n");
  EXPECT_THAT(*files_of_model(file), ElementsAre("c.png", "gone.mtl", "lib/a.mtl", "lib/bump.png", "lib/n.png",
                                                 "lib/old oak.png", "with blank.mtl"));
}

TEST(ModelReferences, OthersHaveNoneAndAFileThatIsNotThereIsAnError) {
  const ScratchFolder folder;
  EXPECT_THAT(*files_of_model(folder.write("a.stl", cube_stl())), IsEmpty());
  EXPECT_THAT(files_of_model(folder.path() / "gone.glb").error(),
              test::is_error(ErrorCode::io_failure, 0, {"gone.glb"}));
}

RC_GTEST_PROP(ModelReferences, AnyBytesGiveAnAnswer, (const std::string& bytes)) {
  const ScratchFolder folder(folder_in_memory());
  const std::string half = cube_glb().substr(0, bytes.size() * 7 % 1500) + bytes;
  for (const char* name : {"a.gltf", "a.glb", "a.obj"}) {
    RC_ASSERT(files_of_model(folder.write(name, bytes)).has_value());
    RC_ASSERT(files_of_model(folder.write(name, half)).has_value());
    RC_ASSERT(files_of_model(folder.write(name, "mtllib " + std::string(name) + "\nmap_Kd " + bytes)).has_value());
  }
}

}  // namespace
}  // namespace mechane::content
