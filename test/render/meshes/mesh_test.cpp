#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/config/config.h"
#include "core/error.h"
#include "own_folder.h"
#include "render/meshes/load_mesh.h"
#include "render/scene.h"

namespace tera {
namespace {

class MeshFile : public testing::Test {
 protected:
  std::filesystem::path Write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  static std::string Message(const std::filesystem::path& file, const std::string& node) {
    try {
      LoadMesh(file, node);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no InputError";
  }

  const std::filesystem::path folder_ = OwnFolder();
};

std::filesystem::path Excavator() { return DataRoot() / "assets" / "tb235.glb"; }

TEST_F(MeshFile, MissingFileIsNamed) {
  EXPECT_THAT(
      Message(folder_ / "nowhere.glb", ""),
      testing::AllOf(testing::HasSubstr("nowhere.glb"), testing::HasSubstr("no such mesh")));
}

TEST_F(MeshFile, MissingNodeListsTheNodesThereAre) {
  EXPECT_THAT(Message(Excavator(), "buckett"),
              testing::AllOf(testing::HasSubstr("has no node 'buckett'"),
                             testing::HasSubstr("did you mean 'bucket'"),
                             testing::HasSubstr("undercarriage")));
}

TEST_F(MeshFile, TruncatedGlbIsRefused) {
  std::ifstream in(Excavator(), std::ios::binary);
  const std::string all((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  ASSERT_GT(all.size(), 1000u);
  for (const std::size_t length : {std::size_t{0}, std::size_t{11}, all.size() / 2}) {
    EXPECT_THAT(Message(Write("cut.glb", all.substr(0, length)), ""), testing::HasSubstr("cut.glb"))
        << length;
  }
  EXPECT_THAT(Message(Write("text.glb", "this is not a mesh"), ""),
              testing::HasSubstr("not a readable glTF"));
}

TEST_F(MeshFile, ObjWithoutTrianglesIsRefused) {
  EXPECT_THAT(Message(Write("empty.obj", "v 0 0 0\n"), ""), testing::HasSubstr("empty.obj"));
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

TEST_F(MeshFile, GltfIsTurnedToZUp) {
  // One triangle at glTF (0,0,0) (1,0,0) (0,2,0), moved by its node to y = 5: it stands upright in
  // our x-z plane. Buffer: three float vec3, base64.
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
  // In the node's own frame the node's place does not count.
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
