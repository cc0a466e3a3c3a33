#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/config/config.h"
#include "core/faults.h"
#include "own_folder.h"
#include "render/meshes/load_mesh.h"
#include "render/meshes/png_bytes.h"
#include "render/scene.h"

namespace tera {
namespace {

using enum FaultKind;
class MeshFile : public testing::Test {
 protected:
  std::filesystem::path Write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  static std::vector<InputFault> FaultsOf(const std::filesystem::path& file,
                                          const std::string& node) {
    return FaultsIn([&] { LoadMesh(file, node); });
  }

  const std::filesystem::path folder_ = OwnFolder();
};

std::filesystem::path Excavator() { return DataRoot() / "assets" / "tb235.glb"; }

TEST_F(MeshFile, MissingFileIsNamed) {
  EXPECT_THAT(FaultsOf(folder_ / "nowhere.glb", ""), HasFault(kUnreadable, "nowhere.glb"));
}

TEST_F(MeshFile, MissingNodeListsTheNodesThereAre) {
  EXPECT_THAT(FaultsOf(Excavator(), "buckett"), HasFault(kNoSuchName));
}

TEST_F(MeshFile, TruncatedGlbIsRefused) {
  std::ifstream in(Excavator(), std::ios::binary);
  const std::string all((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  ASSERT_GT(all.size(), 1000u);
  for (const std::size_t length : {std::size_t{0}, std::size_t{11}, all.size() / 2}) {
    EXPECT_THAT(FaultsOf(Write("cut.glb", all.substr(0, length)), ""), HasFaultAt("cut.glb"))
        << length;
  }
  EXPECT_THAT(FaultsOf(Write("text.glb", "this is not a mesh"), ""),
              HasFault(kMalformed, "text.glb"));
}

TEST_F(MeshFile, ObjWithoutTrianglesIsRefused) {
  EXPECT_THAT(FaultsOf(Write("empty.obj", "v 0 0 0\n"), ""), HasFaultAt("empty.obj"));
}

TEST_F(MeshFile, ObjIsTakenAsItIs) {
  const Mesh mesh = LoadMesh(Write("wedge.obj", "v 1 2 3\nv 4 2 3\nv 1 7 3\nf 1 2 3\n"), "");
  ASSERT_EQ(mesh.parts.size(), 1u);
  ASSERT_EQ(mesh.parts[0].positions_m.size(), 3u);
  Eigen::AlignedBox3f box;
  for (const auto& p : mesh.parts[0].positions_m) box.extend(p);
  EXPECT_EQ(box.min(), Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(box.max(), Eigen::Vector3f(4, 7, 3));
  EXPECT_NEAR(std::abs(mesh.parts[0].normals[0].z()), 1.0f, 1e-6f);
}

/// A triangle of 100 cm with a texture, as exported for robots.
constexpr const char* kTexturedDae = R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
  <library_images><image id="pic" name="pic"><init_from>textures/paint%20one.png</init_from></image></library_images>
  <library_effects><effect id="fx"><profile_COMMON>
    <newparam sid="surf"><surface type="2D"><init_from>pic</init_from></surface></newparam>
    <newparam sid="samp"><sampler2D><source>surf</source></sampler2D></newparam>
    <technique sid="common"><lambert><diffuse><texture texture="samp" texcoord="UVMap"/></diffuse></lambert></technique>
  </profile_COMMON></effect></library_effects>
  <library_materials><material id="mat" name="mat"><instance_effect url="#fx"/></material></library_materials>
  <library_geometries><geometry id="g" name="g"><mesh>
    <source id="p"><float_array id="pa" count="9">0 0 0 100 0 0 0 100 0</float_array>
      <technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
    <source id="t"><float_array id="ta" count="6">0 0 1 0 0 1</float_array>
      <technique_common><accessor source="#ta" count="3" stride="2"><param name="S" type="float"/><param name="T" type="float"/></accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles material="m" count="1"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="TEXCOORD" source="#t" offset="1" set="0"/><p>0 0 1 1 2 2</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s"><node id="n" name="n"><instance_geometry url="#g"><bind_material><technique_common>
    <instance_material symbol="m" target="#mat"><bind_vertex_input semantic="UVMap" input_semantic="TEXCOORD" input_set="0"/></instance_material>
  </technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>)";

TEST_F(MeshFile, TheTextureOfADaeFileIsDrawn) {
  std::filesystem::create_directories(folder_ / "textures");
  const testing_mesh::Rgb red = {255, 0, 0};
  Write("textures/paint one.png", testing_mesh::PngBytes({{red}}));
  const Mesh mesh = LoadMesh(Write("arm.dae", kTexturedDae), "");
  ASSERT_EQ(mesh.parts.size(), 1u);
  const MeshPart& part = mesh.parts[0];
  EXPECT_TRUE(part.positions_m[1].isApprox(Eigen::Vector3f(1, 0, 0)));
  ASSERT_NE(part.material.textures.base_colour, nullptr);
  EXPECT_EQ(part.material.textures.base_colour->rgba.at(0), 255);
  EXPECT_EQ(part.material.textures.base_colour->rgba.at(1), 0);
  ASSERT_EQ(part.uvs.size(), 3u);
  EXPECT_FLOAT_EQ(part.uvs[1].x(), 1);
}

TEST_F(MeshFile, APictureOfADaeFileThatIsNotThereIsNamed) {
  EXPECT_THAT(FaultsOf(Write("arm.dae", kTexturedDae), ""), HasFault(kMalformed, "arm.dae"));
}

TEST_F(MeshFile, GltfIsTurnedToZUp) {
  // One triangle at glTF (0,0,0) (1,0,0) (0,2,0), moved by its node to y = 5: it stands upright in
  // TERA's x-z plane. Buffer: three float vec3, base64.
  const std::string buffer = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA";
  const std::filesystem::path file =
      Write("up.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
      "nodes":[{"name":"sail","mesh":0,"translation":[0,5,0]}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
        "min":[0,0,0],"max":[1,2,0]}],
      "bufferViews":[{"buffer":0,"byteLength":36}],
      "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)" +
                           buffer + "\"}]}");
  const Mesh whole = LoadMesh(file, "");
  EXPECT_TRUE(whole.parts.at(0).positions_m.at(2).isApprox(Eigen::Vector3f(0, 0, 7)));
  EXPECT_TRUE(whole.parts.at(0).normals.at(0).isApprox(Eigen::Vector3f(0, -1, 0)));
  // In the node's own frame the node's place is irrelevant.
  const Mesh own = LoadMesh(file, "sail");
  EXPECT_TRUE(own.parts.at(0).positions_m.at(2).isApprox(Eigen::Vector3f(0, 0, 2)));
}

TEST_F(MeshFile, SameFileAndNodeIsLoadedOnce) {
  SceneModel model;
  const int bucket = model.AddMesh(Excavator(), "bucket"), arm = model.AddMesh(Excavator(), "arm");
  EXPECT_NE(bucket, arm);
  EXPECT_EQ(model.AddMesh(Excavator(), "bucket"), bucket);
  EXPECT_EQ(model.meshes.size(), 2u);
}

}  // namespace
}  // namespace tera
