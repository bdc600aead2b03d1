// Two bodies from a .part file (as `mechane fit` writes it): where they overlap, how deep, and which way they are to be pushed apart.
#include <array>
#include <cstdio>

#include <server/collision/object_io.hpp>

using namespace mechane;

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "contacts FILE.part\n"), 2;
  const auto object = collision::load_object(argv[1]);
  if (!object) return std::fprintf(stderr, "%s\n", object.error().to_string().c_str()), 1;

  const Pose X_WA{Vec3(0, 0, 2 * object->bound_O.radius - 0.002), Quat::Identity()};  // 2 mm into the other
  const Pose X_WB;
  std::array<collision::PointContact, 256> storage;
  collision::ContactBuffer found(storage);
  collision::find_contacts(*object, X_WA, *object, X_WB, found);
  double deepest_m = 0;
  for (const collision::PointContact& contact : found.contacts()) {
    std::printf("%.2f mm deep at (%.3f, %.3f, %.3f), push A along (%.2f, %.2f, %.2f)\n", 1000 * contact.depth_m,
                contact.p_WC.x(), contact.p_WC.y(), contact.p_WC.z(), contact.n_BA_W.x(), contact.n_BA_W.y(),
                contact.n_BA_W.z());
    deepest_m = std::max(deepest_m, contact.depth_m);
  }
  return deepest_m > 0.001 && deepest_m < 0.003 ? 0 : 1;
}
