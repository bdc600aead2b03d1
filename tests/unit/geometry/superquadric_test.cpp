#include "server/geometry/superquadric.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "server/geometry/mesh_check.hpp"
#include "server/geometry/superquadric_mesh.hpp"

namespace mechane::geometry {
namespace {

TEST(Superquadric, SphereIsTheSquareOfTheDistance) {
  Superquadric s;
  s.a = Vec3::Constant(2);
  EXPECT_DOUBLE_EQ(inside_outside(s, {2, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(inside_outside(s, {0, 1, 0}), 0.25);
  EXPECT_DOUBLE_EQ(inside_outside(s, {0, 0, 4}), 4);
  EXPECT_DOUBLE_EQ(radial_form(s, {0, 0, 3}), 1.5);
  const Vec3 p = Vec3(1, 2, -2) * (2.0 / 3);
  EXPECT_NEAR((surface_normal(s, angles_of(s, p)) - p / 2).norm(), 0, 1e-12);
  EXPECT_NEAR((gradient(s, p) - p / 2).norm(), 0, 1e-12);
}

TEST(Superquadric, EllipsoidHasItsTextbookNormal) {
  Superquadric s;
  s.a = {1, 2, 3};
  const Vec3 p = surface_point(s, {0.4, 2.1});
  const Vec3 n = p.cwiseQuotient(s.a.cwiseProduct(s.a)).normalized();
  EXPECT_NEAR((surface_normal(s, {0.4, 2.1}) - n).norm(), 0, 1e-12);
  EXPECT_NEAR(inside_outside(s, p), 1, 1e-12);
}

TEST(Superquadric, SmallExponentsMakeABox) {
  Superquadric s;
  s.a = {1, 2, 3};
  s.e1 = s.e2 = 0.1;
  EXPECT_LT(inside_outside(s, {0.93, 1.86, 2.7}), 1);
  EXPECT_GT(inside_outside(s, {1.01, 0, 0}), 1);
  EXPECT_NEAR((surface_normal(s, angles_of(s, {1, 0.5, 0.5})) - Vec3::UnitX()).norm(), 0, 1e-3);
}

TEST(Superquadric, TaperAndBendMoveKnownPoints) {
  Superquadric s;
  s.a = {0.1, 0.2, 1};
  s.taper_x = 0.5;
  s.taper_y = -0.5;
  EXPECT_NEAR((deform(s, {0.1, 0.2, 1}) - Vec3(0.15, 0.1, 1)).norm(), 0, 1e-15);
  Superquadric bent;
  bent.a = {0.1, 0.1, 1};
  bent.bend_per_m = kPi / 2;  // a quarter circle of radius 2 / pi, towards +x
  const double radius = 2 / kPi;
  EXPECT_NEAR((deform(bent, {0, 0, 1}) - Vec3(radius, 0, radius)).norm(), 0, 1e-12);
}

TEST(Superquadric, WhatCannotBeIsNotValid) {
  Superquadric s;
  EXPECT_TRUE(is_valid(s));
  s.a.x() = 0;
  EXPECT_FALSE(is_valid(s));
  s.a.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_valid(s));
  s.a.x() = 1;
  s.bend_per_m = 2;  // folds over itself
  EXPECT_FALSE(is_valid(s));
  s.bend_per_m = 0;
  s.taper_x = 1;
  EXPECT_FALSE(is_valid(s));
}

TEST(Superquadric, TessellationIsClosedAndOnTheSurface) {
  Superquadric s;
  s.a = {0.1, 0.2, 0.3};
  s.e1 = 0.2;
  s.e2 = 1.5;
  s.taper_x = 0.4;
  s.bend_per_m = 0.8;
  const Mesh mesh = tessellate(s, 12);
  EXPECT_EQ(open_edges(mesh), 0U);
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    volume += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
  }
  EXPECT_GT(volume, 0.01);  // outwards
  for (const Vec3& v : mesh.vertices)
    EXPECT_NEAR(radial_form(s, v), 1, 1e-9);
}

}  // namespace
}  // namespace mechane::geometry
