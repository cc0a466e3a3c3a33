#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/faults.h"
#include "own_folder.h"
#include "render/meshes/load_mesh.h"
#include "render/meshes/near_infrared.h"
#include "render/meshes/png_bytes.h"
#include "render/meshes/textured_gltf.h"
#include "render/scene.h"

namespace tera {
namespace {

using enum FaultKind;
using testing_mesh::PngBytes;
using testing_mesh::WriteTexturedSquare;

const std::string kBaseColour =
    R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,1],"baseColorTexture":{"index":0}})";
const std::string kPicture = R"({"uri":"paint.png"})";

class GltfTextures : public ::testing::Test {
 protected:
  void WritePicture(const std::string& bytes) const {
    std::ofstream(folder_ / "paint.png", std::ios::binary) << bytes;
  }
  static std::vector<InputFault> FaultsOf(const std::filesystem::path& file) {
    return FaultsIn([&] { LoadMesh(file, ""); });
  }

  const std::filesystem::path folder_ = OwnFolder();
};

TEST_F(GltfTextures, APictureBesideTheFileIsReadRowByRowFromTheTop) {
  WritePicture(PngBytes({{{255, 0, 0}, {0, 255, 0}}, {{0, 0, 255}, {128, 128, 128}}}));
  const std::filesystem::path file =
      WriteTexturedSquare(folder_, kBaseColour, kPicture, 1, R"({"wrapS":33071,"wrapT":33648})");
  const Mesh mesh = LoadMesh(file, "");
  const MeshPart& part = mesh.parts.at(0);
  const auto& texture = part.material.textures.base_colour;
  ASSERT_NE(texture, nullptr);
  EXPECT_EQ(texture->width_px, 2);
  EXPECT_EQ(texture->height_px, 2);
  EXPECT_THAT(texture->rgba, ::testing::ElementsAre(255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255,
                                                    128, 128, 128, 255));
  EXPECT_EQ(texture->wrap_x, Texture::Wrap::kClamp);
  EXPECT_EQ(texture->wrap_y, Texture::Wrap::kMirror);
  EXPECT_EQ(part.material.textures.normal, nullptr);
  ASSERT_EQ(part.uvs.size(), 4u);
  EXPECT_EQ(part.uvs[3], Eigen::Vector2f(0, 0));
  EXPECT_TRUE(part.positions_m[3].isApprox(Eigen::Vector3f(-1, 0, 1)));  // upper left
  // sRGB 128 is 0.2159 linear. The factor halves red.
  const double grey = 0.2158605;
  EXPECT_NEAR(NearInfrared(part.material, SemanticClass::kCone), (1 + grey) / 4 * (0.5 + 1 + 1) / 3,
              1e-6);
  // The picture is one of the mesh's files.
  EXPECT_THAT(mesh.files, ::testing::Contains(folder_ / "paint.png"));
}

TEST_F(GltfTextures, MeshesOfOneFileShareTheirPictures) {
  WritePicture(PngBytes({{{255, 0, 0}}}));
  const std::filesystem::path file = WriteTexturedSquare(folder_, kBaseColour, kPicture, 1);
  SceneModel model;
  const int whole = model.AddMesh(file, ""), node = model.AddMesh(file, "square");
  const auto texture = [&](int mesh) {
    return model.meshes[mesh].parts[0].material.textures.base_colour.get();
  };
  EXPECT_NE(whole, node);
  EXPECT_EQ(texture(whole), texture(node));
}

TEST_F(GltfTextures, AMissingPictureIsNamedWithItsRemedy) {
  const std::filesystem::path file = WriteTexturedSquare(folder_, kBaseColour, kPicture, 1);
  EXPECT_THAT(FaultsOf(file), HasFault(kMalformed, "square.gltf"));
}

TEST_F(GltfTextures, APictureThatIsNoneIsNamedWithWhatIsNeeded) {
  for (const std::string& bytes :
       {std::string("this is no picture"), PngBytes({{{1, 2, 3}}}).substr(0, 40)}) {
    WritePicture(bytes);
    const std::filesystem::path file = WriteTexturedSquare(folder_, kBaseColour, kPicture, 1);
    EXPECT_THAT(FaultsOf(file), HasFault(kMalformed, "square.gltf"));
  }
  WritePicture("");
  EXPECT_THAT(FaultsOf(WriteTexturedSquare(folder_, kBaseColour, kPicture, 1)),
              HasFault(kMalformed, "square.gltf"));
}

TEST_F(GltfTextures, APictureThatNoMaterialUsesMayBeMissing) {
  const std::filesystem::path file =
      WriteTexturedSquare(folder_, R"("emissiveFactor":[0.2,0.1,0])", kPicture, 1);
  const Mesh mesh = LoadMesh(file, "");
  EXPECT_FALSE(mesh.parts[0].material.textures.any());
  EXPECT_EQ(mesh.parts[0].material.emission, Vec3(0.2, 0.1, 0));
}

TEST_F(GltfTextures, WhatIsNotDrawnIsRefused) {
  WritePicture(PngBytes({{{1, 2, 3}}}));
  const auto faults = [&](const std::string& material) {
    return FaultsOf(WriteTexturedSquare(folder_, material, kPicture, 1));
  };
  EXPECT_THAT(faults(R"("emissiveTexture":{"index":0,
      "extensions":{"KHR_texture_transform":{"scale":[2,2]}}})"),
              HasFault(kUnsupported));
  EXPECT_THAT(faults(kBaseColour + R"(,"normalTexture":{"index":0,"texCoord":1})"),
              HasFault(kUnsupported));
  EXPECT_THAT(faults(R"("normalTexture":{"index":0,"texCoord":1})"),
              HasFault(kMissing, "square.gltf"));
  EXPECT_THAT(faults(R"("normalTexture":{"index":4})"), HasFault(kNoSuchName));
}

}  // namespace
}  // namespace tera
