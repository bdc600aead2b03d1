// A ball of 5 cm, made ready from its mesh, written to ball.part, and asked how deep a fingertip's points lie in it.
#include <array>
#include <cstdio>
#include <fstream>

#include <server/collision/object_io.hpp>
#include <server/collision/point_query.hpp>
#include <server/collision_build/object_builder.hpp>
#include <server/geometry/superquadric_mesh.hpp>

using namespace mechane;

int main() {
  geometry::Superquadric ball;
  ball.a = Vec3::Constant(0.05);
  const std::array<geometry::NamedMesh, 1> meshes = {{{"ball", geometry::tessellate(ball, 24)}}};
  collision_build::BuildReport report;
  const auto object = collision_build::build_object(meshes, {}, &report);
  if (!object) return std::fprintf(stderr, "%s\n", object.error().to_string().c_str()), 1;

  const std::vector<std::byte> bytes = collision::write_object(*object);
  std::ofstream("ball.part", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));

  collision::PointBlock points{};  // 16 points on a line through the ball's middle
  for (std::size_t i = 0; i < collision::kLanes; ++i)
    points.x[i] = 0.005F * static_cast<float>(i);
  collision::SphereBlock around{};  // one cluster in one group
  around.x[0] = around.radius[0] = 0.0375F;
  const collision::PointSet set{points.view(), around.view(), around.view(), 1, 1, {0.0375F, 0, 0}, 0.0375F};

  collision::PointHits hits(collision::kLanes);
  collision::PlacedObject(*object, Pose{}).query(set, hits);
  for (std::size_t i = 0; i < hits.count; ++i)
    std::printf("point %2u lies %.2f mm deep\n", hits.point[i], 1000 * static_cast<double>(hits.depth_m[i]));
  return hits.count == 10 && report.parts.front().met ? 0 : 1;
}
