#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

/// A glTF file of one square with textures, for tests.

namespace tera::testing_mesh {

/// Writes `name`.gltf and its buffer into a folder: a square of 2 m in glTF's x-y plane, which is
/// TERA's x-z plane, facing TERA's -y. u runs to the right (x), v down, from the upper left corner.
/// `material` and `pictures` are parts of the JSON; texture k shows picture k.
inline std::filesystem::path WriteTexturedSquare(const std::filesystem::path& folder,
                                                 const std::string& material,
                                                 const std::string& pictures, int picture_count,
                                                 const std::string& sampler = "{}") {
  const float numbers[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0,  // positions
                           0,  1,  1, 1, 1,  0, 0, 0};              // u, v
  const std::uint16_t indices[] = {0, 1, 2, 0, 2, 3};
  std::string buffer(sizeof(numbers) + sizeof(indices), '\0');
  std::memcpy(buffer.data(), numbers, sizeof(numbers));
  std::memcpy(buffer.data() + sizeof(numbers), indices, sizeof(indices));
  std::ofstream(folder / "square.bin", std::ios::binary) << buffer;
  std::string textures;
  for (int k = 0; k < picture_count; ++k) {
    textures +=
        (k > 0 ? "," : "") + std::string("{\"sampler\":0,\"source\":") + std::to_string(k) + "}";
  }
  std::ofstream(folder / "square.gltf")
      << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
      "nodes":[{"name":"square","mesh":0}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,
        "material":0}]}],
      "materials":[{"name":"paint",)"
      << material << R"(}],"textures":[)" << textures << R"(],"images":[)" << pictures
      << R"(],"samplers":[)" << sampler << R"(],
      "accessors":[
        {"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
        {"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},
        {"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],
      "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},
        {"buffer":0,"byteOffset":80,"byteLength":12}],
      "buffers":[{"byteLength":92,"uri":"square.bin"}]})";
  return folder / "square.gltf";
}

}  // namespace tera::testing_mesh
