#include "render/meshes/top_of_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace tera {
namespace {

/// A part of triangles, each given by three corners.
MeshPart PartOf(const std::vector<Eigen::Vector3f>& corners) {
  MeshPart part;
  part.positions_m = corners;
  for (std::uint32_t i = 0; i < corners.size(); ++i) part.indices.push_back(i);
  return part;
}

/// z = 0.3 x + 0.1 y + 1 over [0, 4] x [0, 2].
MeshPart Ramp() {
  const auto at = [](float x, float y) { return Eigen::Vector3f(x, y, 0.3f * x + 0.1f * y + 1); };
  return PartOf({at(0, 0), at(4, 0), at(4, 2), at(0, 0), at(4, 2), at(0, 2)});
}

TEST(TopOfMesh, IsThePlaneOfARampUpToItsEdgesAndNothingBeyond) {
  const Mesh mesh{"ramp", {Ramp()}, {}};
  const TopOfMesh top = TopOf(mesh, Vec2(-0.5, 0), 0.5, 11, 5);
  for (int j = 0; j < top.ny; ++j) {
    for (int i = 0; i < top.nx; ++i) {
      const double x = -0.5 + 0.5 * i, y = 0.5 * j;
      const float z = top.height_m[top.index(i, j)];
      const bool is_over = x >= 0 && x <= 4;
      EXPECT_EQ(std::isnan(z), !is_over) << x << " " << y;
      if (is_over) {
        EXPECT_NEAR(z, 0.3 * x + 0.1 * y + 1, 1e-5);
      }
    }
  }
}

TEST(TopOfMesh, IsTheHighestOfWhatLiesAboveEachOtherInAnyOrder) {
  MeshPart shelf = PartOf({{1, 0, 3}, {2, 0, 3}, {2, 2, 3}, {1, 0, 3}, {2, 2, 3}, {1, 2, 3}});
  shelf.material.albedo = Vec3(1, 0, 0);
  for (const auto& parts : {std::vector{Ramp(), shelf}, std::vector{shelf, Ramp()}}) {
    const TopOfMesh top = TopOf(Mesh{"both", parts, {}}, Vec2(0.5, 1), 1, 2, 1);
    EXPECT_NEAR(top.height_m[0], 1.25, 1e-5);
    EXPECT_NEAR(top.height_m[1], 3, 1e-6);
    EXPECT_EQ(top.albedo[1], Eigen::Vector3f(1, 0, 0));
  }
}

TEST(TopOfMesh, HasTheColourOfTheTextureAtThatPoint) {
  // One column of 0 (black) and one of 255 (white): linear 0 and 1, interpolated between their
  // middles.
  auto picture = std::make_shared<Texture>();
  picture->width_px = 2;
  picture->height_px = 1;
  picture->rgba = {0, 0, 0, 255, 255, 255, 255, 255};
  picture->wrap_x = picture->wrap_y = Texture::Wrap::kClamp;
  MeshPart part = Ramp();
  part.material.albedo = Vec3(0.8, 0.4, 0.2);
  part.material.textures.base_colour = picture;
  for (const Eigen::Vector3f& p : part.positions_m) part.uvs.emplace_back(p.x() / 4, p.y() / 2);
  const TopOfMesh top = TopOf(Mesh{"ramp", {part}, {}}, Vec2(0.5, 0.7), 1, 4, 1);
  const float share[] = {0, 0.25, 0.75, 1};  // at u = 1/8, 3/8, 5/8, 7/8
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(top.albedo[i].x(), 0.8f * share[i], 1e-5) << i;
    EXPECT_NEAR(top.albedo[i].z(), 0.2f * share[i], 1e-5) << i;
  }
}

}  // namespace
}  // namespace tera
