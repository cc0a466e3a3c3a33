#include "render/meshes/load_mesh.h"
#include "untrusted_file.h"

// The input's first byte chooses the format, otherwise given by the file name.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr const char* kNames[] = {"a.glb", "a.gltf", "a.stl", "a.obj", "a.dae"};
  return tera::ReadAsFile(kNames[data[0] % 5], data + 1, size - 1,
                          [](const std::filesystem::path& file) { tera::LoadMesh(file, ""); });
}
