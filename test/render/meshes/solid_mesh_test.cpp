#include "render/meshes/solid_mesh.h"

#include <gtest/gtest.h>

#include "core/units.h"
#include "render/meshes/painted_parts.h"

namespace tera {
namespace {

Eigen::Vector3d Corner(const MeshPart& part, std::size_t i) {
  return part.positions_m[part.indices[i]].cast<double>();
}

/// By the divergence theorem: positive if all triangles face outwards.
double Volume_m3(const Mesh& mesh) {
  double volume_m3 = 0;
  for (const MeshPart& part : mesh.parts) {
    for (std::size_t i = 0; i < part.indices.size(); i += 3) {
      volume_m3 += Corner(part, i).dot(Corner(part, i + 1).cross(Corner(part, i + 2))) / 6;
    }
  }
  return volume_m3;
}

Mesh Make(SolidForm form, const Vec3& size_m) { return MakeSolidMesh({form, size_m}, {}); }

TEST(SolidMesh, EnclosesItsVolume) {
  EXPECT_NEAR(Volume_m3(Make(SolidForm::kBox, {1, 2, 3})), 6.0, 1e-5);
  // A prism over a regular polygon of 32 corners on the circle: 16 sin(2 pi / 32) r^2 h.
  EXPECT_NEAR(Volume_m3(Make(SolidForm::kCylinder, {2, 2, 3})), 16 * std::sin(kPi / 16) * 3, 1e-5);
  // Facets lie slightly inside a ball.
  const double ball_m3 = 4.0 / 3 * kPi;
  const double facets_m3 = Volume_m3(Make(SolidForm::kSphere, {2, 2, 2}));
  EXPECT_LT(facets_m3, ball_m3);
  EXPECT_GT(facets_m3, 0.98 * ball_m3);
}

TEST(SolidMesh, NormalsAreUnitAndFaceAsTheirTrianglesDo) {
  for (const SolidForm form : {SolidForm::kBox, SolidForm::kSphere, SolidForm::kCylinder}) {
    const Mesh mesh = Make(form, {0.6, 0.6, 1.4 * (form != SolidForm::kSphere) + 0.6});
    for (const MeshPart& part : mesh.parts) {
      ASSERT_EQ(part.normals.size(), part.positions_m.size());
      for (std::size_t i = 0; i < part.indices.size(); i += 3) {
        const Vec3 face =
            (Corner(part, i + 1) - Corner(part, i)).cross(Corner(part, i + 2) - Corner(part, i));
        ASSERT_GT(face.norm(), 1e-8);
        for (std::size_t k = i; k < i + 3; ++k) {
          const Vec3 n = part.normals[part.indices[k]].cast<double>();
          ASSERT_NEAR(n.norm(), 1, 1e-5);
          ASSERT_GT(n.dot(face.normalized()), 0.97);  // 11 deg from facet to facet
        }
      }
    }
  }
}

TEST(SolidMesh, TheSameSolidIsInTheSceneOnceInEachColour) {
  SceneModel scene;
  const Solid box{SolidForm::kBox, {1, 2, 3}}, other{SolidForm::kBox, {1, 2, 4}};
  const Paint red{{1, 0, 0}, 1}, blue{{0, 0, 1}, 1};
  EXPECT_EQ(AddSolid(box, red, &scene), AddSolid(box, red, &scene));
  EXPECT_NE(AddSolid(box, red, &scene), AddSolid(box, blue, &scene));
  EXPECT_NE(AddSolid(box, red, &scene), AddSolid(other, red, &scene));
  EXPECT_EQ(scene.meshes.size(), 3u);
}

}  // namespace
}  // namespace tera
