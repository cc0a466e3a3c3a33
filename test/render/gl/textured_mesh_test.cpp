#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "own_folder.h"
#include "render/gl/rasterizer_stage.h"
#include "render/meshes/png_bytes.h"
#include "render/meshes/textured_gltf.h"
#include "render/rays/ray_scene.h"

namespace tera {
namespace {

using testing_mesh::PngBytes;
using testing_mesh::Rgb;
using testing_mesh::WriteTexturedSquare;

const std::string kClamped = R"({"wrapS":33071,"wrapT":33071})";

/// A square of 2 m, 4 m before a camera that looks along +y of W, in the light of a sun behind the
/// camera.
class TexturedMesh : public ::testing::Test {
 protected:
  void WritePicture(int k, const std::vector<std::vector<Rgb>>& rows) const {
    std::ofstream(folder_ / ("p" + std::to_string(k) + ".png"), std::ios::binary) << PngBytes(rows);
  }
  /// The scene of a square with that material, with this number of pictures p0, p1...
  SceneModel Scene(const std::string& material, int pictures) const {
    std::string list;
    for (int k = 0; k < pictures; ++k) {
      list += (k > 0 ? "," : "") + std::string(R"({"uri":"p)") + std::to_string(k) + ".png\"}";
    }
    SceneModel model;
    model.instances = {{.name = "none"}, {.name = "square", .body = 0}};
    model.soils.emplace_back();
    model.body_count = 1;
    model.environment.to_sun_W = Vec3(0.3, -0.8, 0.5).normalized();
    SceneNode node;
    node.mesh = model.AddMesh(WriteTexturedSquare(folder_, material, list, pictures, kClamped), "");
    node.instance = 1;
    model.nodes.push_back(node);
    return model;
  }
  static CameraFrame Shoot(const SceneModel& model) {
    Rasterizer rasterizer(model, {});
    SceneState state;
    state.X_WB = {MakePose(Vec3(1, 6, 2))};
    LabelSet labels;
    labels.set();
    return rasterizer.Render(Pinhole(), LookAt(Vec3(1, 2, 2), Vec3(1, 6, 2)), state, labels);
  }
  CameraFrame Shoot(const std::string& material, int pictures) const {
    return Shoot(Scene(material, pictures));
  }
  /// Mean of a colour over 11 x 11 pixels about a place of the square, from -1 to 1 m.
  static double Colour(const CameraFrame& frame, double x_m, double z_m, int c) {
    const CameraIntrinsics camera = Pinhole();
    const int x = std::lround(camera.cx_px + camera.fx_px * x_m / 4);
    const int y = std::lround(camera.cy_px - camera.fy_px * z_m / 4);
    double sum = 0;
    for (int i = -5; i <= 5; ++i) {
      for (int j = -5; j <= 5; ++j) sum += frame.rgb.at(x + i, y + j, c) / 121.0;
    }
    return sum;
  }

  const std::filesystem::path folder_ = OwnFolder();
};

const std::string kBaseColour =
    R"("pbrMetallicRoughness":{"metallicFactor":0,"baseColorTexture":{"index":0}})";

TEST_F(TexturedMesh, ColoursAreWhereThePictureHasThem) {
  WritePicture(0, {{{200, 0, 0}, {0, 200, 0}}, {{0, 0, 200}, {200, 200, 200}}});
  const CameraFrame frame = Shoot(kBaseColour, 1);
  const auto is = [&](double x_m, double z_m, int strong) {
    for (int c = 0; c < 3; ++c) {
      if (c == strong) continue;
      EXPECT_GT(Colour(frame, x_m, z_m, strong), 2 * Colour(frame, x_m, z_m, c))
          << x_m << " " << z_m;
    }
  };
  is(-0.8, 0.8, 0);  // upper left is red
  is(0.8, 0.8, 1);
  is(-0.8, -0.8, 2);
  EXPECT_NEAR(Colour(frame, 0.8, -0.8, 0), Colour(frame, 0.8, -0.8, 1), 25);
}

TEST_F(TexturedMesh, LooksAsAMaterialOfThatColourDoes) {
  WritePicture(0, {{{188, 188, 188}}});  // 0.5029 linear
  const double textured = Colour(Shoot(kBaseColour, 1), 0, 0, 1);
  const double plain = Colour(
      Shoot(
          R"("pbrMetallicRoughness":{"metallicFactor":0,"baseColorFactor":[0.503,0.503,0.503,1]})",
          0),
      0, 0, 1);
  EXPECT_NEAR(textured, plain, 1.5);
}

TEST_F(TexturedMesh, FineColoursAverageFarAwayByTheirMipmaps) {
  // A board of single black and white pixels, much finer than the picture's: linear 0.5.
  std::vector<std::vector<Rgb>> board(1024, std::vector<Rgb>(16));
  for (std::size_t y = 0; y < board.size(); ++y) {
    for (std::size_t x = 0; x < 16; ++x)
      board[y][x] = (x + y) % 2 == 0 ? Rgb{255, 255, 255} : Rgb{};
  }
  WritePicture(0, board);
  const CameraFrame frame = Shoot(kBaseColour, 1);
  const double plain = Colour(
      Shoot(R"("pbrMetallicRoughness":{"metallicFactor":0,"baseColorFactor":[0.5,0.5,0.5,1]})", 0),
      0.3, 0.2, 1);
  EXPECT_NEAR(Colour(frame, 0.3, 0.2, 1), plain, 8);
}

TEST_F(TexturedMesh, ANormalMapTurnsNormalsToTheRightAndUp) {
  // (sin 30, 0, cos 30) to the right, then (0, sin 30, cos 30) up; x is red, y is green.
  const auto normal_W = [&](const Rgb& rgb) {
    WritePicture(0, {{rgb}});
    const CameraFrame frame = Shoot(R"("normalTexture":{"index":0})", 1);
    const Vec3 n_C(frame.normal.at(160, 118, 0) / 32767.0 - 1,
                   frame.normal.at(160, 118, 1) / 32767.0 - 1,
                   frame.normal.at(160, 118, 2) / 32767.0 - 1);
    return Vec3(n_C.x(), n_C.z(), -n_C.y());  // the camera looks along y, its x is W's
  };
  EXPECT_LT((normal_W({128, 128, 255}) - Vec3(0, -1, 0)).norm(), 0.01);
  EXPECT_LT((normal_W({191, 128, 238}) - Vec3(0.5, -std::sqrt(0.75), 0)).norm(), 0.02);
  EXPECT_LT((normal_W({128, 191, 238}) - Vec3(0, -std::sqrt(0.75), 0.5)).norm(), 0.02);
}

TEST_F(TexturedMesh, WhereTheMapShutsOutTheSkyOnlyTheSunIsLeft) {
  WritePicture(0, {{{255, 255, 255}, {0, 0, 0}}});
  SceneModel model = Scene(
      R"("pbrMetallicRoughness":{"metallicFactor":0,"baseColorFactor":[0.3,0.3,0.3,1]},
         "occlusionTexture":{"index":0})",
      1);
  const CameraFrame lit = Shoot(model);
  EXPECT_GT(Colour(lit, 0.8, 0, 1), 60);
  EXPECT_EQ(lit.instance.at(160, 118), 1);
  model.environment.to_sun_W = Vec3(0.3, 0.8, 0.5).normalized();  // behind the square
  const CameraFrame shaded = Shoot(model);
  EXPECT_GT(Colour(shaded, -0.8, 0, 1), 40);
  EXPECT_LT(Colour(shaded, 0.8, 0, 1), 10);
}

TEST_F(TexturedMesh, MetalIsBlueOfItsMapAndReflectsTheSkyAlone) {
  WritePicture(0, {{{0, 255, 0}, {0, 255, 255}}});
  const CameraFrame frame =
      Shoot(R"("pbrMetallicRoughness":{"metallicRoughnessTexture":{"index":0}})", 1);
  EXPECT_GT(std::abs(Colour(frame, -0.8, 0, 0) - Colour(frame, 0.8, 0, 0)), 10);
}

TEST_F(TexturedMesh, ALampIsBrightWhereItsPictureIs) {
  WritePicture(0, {{{255, 255, 255}, {0, 0, 0}}});
  const std::string dark =
      R"("pbrMetallicRoughness":{"metallicFactor":0,"baseColorFactor":[0.02,0.02,0.02,1]})";
  const CameraFrame frame =
      Shoot(dark + R"(,"emissiveFactor":[1,0.1,0.1],"emissiveTexture":{"index":0})", 1);
  EXPECT_GT(Colour(frame, -0.8, 0, 0), 200);
  EXPECT_GT(Colour(frame, -0.8, 0, 0), 1.5 * Colour(frame, -0.8, 0, 1));
  const double unlit = Colour(Shoot(dark, 0), 0.8, 0, 0);
  EXPECT_NEAR(Colour(frame, 0.8, 0, 0), unlit, 2);
}

TEST_F(TexturedMesh, ALidarSeesThePicturesMean) {
  WritePicture(0, {{{255, 255, 255}, {0, 0, 0}}});
  RayScene scene(Scene(kBaseColour, 1));
  scene.Update({{MakePose(Vec3(1, 6, 2))}}, TerrainSurface());
  const Ray ray{.origin_W_m = {1.2f, 2, 2.1f}, .direction_W = Eigen::Vector3f::UnitY()};
  RayHit hit;
  scene.Trace(std::span(&ray, 1), std::span(&hit, 1), 1);
  EXPECT_NEAR(hit.range_m, 4, 1e-4);
  EXPECT_NEAR(hit.reflectance, 0.5, 1e-6);
}

}  // namespace
}  // namespace tera
