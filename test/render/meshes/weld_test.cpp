#include "render/meshes/weld.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/meshes/solid_mesh.h"

namespace tera {
namespace {

MeshPart BoxPart() { return MakeSolidMesh({SolidForm::kBox, {1, 2, 3}}, {}).parts.at(0); }

/// Without its last triangles.
MeshPart Opened(MeshPart part, std::size_t triangles) {
  part.indices.resize(part.indices.size() - 3 * triangles);
  return part;
}

MeshPart InsideOut(MeshPart part) {
  std::reverse(part.indices.begin(), part.indices.end());
  return part;
}

TEST(Weld, ABoxHasEightCornersAndItsTwelveTriangles) {
  const MeshPart part = BoxPart();
  ASSERT_EQ(part.positions_m.size(), 24u);  // each corner once for each of its three faces
  const Welded welded = Weld({&part});
  EXPECT_EQ(welded.positions_m.size(), 8u);
  ASSERT_EQ(welded.indices.size(), part.indices.size());
  for (std::size_t k = 0; k < welded.indices.size(); ++k) {
    EXPECT_EQ(welded.positions_m[welded.indices[k]], part.positions_m[part.indices[k]]);
  }
}

TEST(Weld, LeavesOutTrianglesWithoutArea) {
  MeshPart part;
  part.positions_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  part.indices = {0, 1, 2, 0, 1, 3};  // the second has a corner twice
  EXPECT_EQ(Weld({&part}).indices, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Weld, KnowsClosedSurfacesThatFaceOutwards) {
  const MeshPart box = BoxPart(), open = Opened(box, 1), inside_out = InsideOut(box);
  EXPECT_EQ(Weld({&box}).closed, 36u);
  EXPECT_EQ(Weld({&open}).closed, 0u);
  EXPECT_EQ(Weld({&inside_out}).closed, 0u);
  EXPECT_EQ(Weld({}).closed, 0u);
}

TEST(Weld, PutsClosedSurfacesBeforeOthersWhateverTheirParts) {
  const MeshPart box = BoxPart();
  MeshPart lid = box, rest = Opened(box, 2), open = Opened(box, 1);
  lid.indices.assign(box.indices.end() - 6, box.indices.end());
  for (Eigen::Vector3f& p : open.positions_m) p.x() += 10;
  const Welded welded = Weld({&open, &lid, &rest});
  EXPECT_EQ(welded.closed, 36u);
  ASSERT_EQ(welded.indices.size(), 36u + 33u);
  for (std::size_t k = 0; k < welded.indices.size(); ++k) {
    EXPECT_EQ(welded.positions_m[welded.indices[k]].x() < 5, k < welded.closed);
  }
}

}  // namespace
}  // namespace tera
