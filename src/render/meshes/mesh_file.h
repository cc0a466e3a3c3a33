#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/meshes/mesh.h"

namespace tera {

/// Frame of the vertices: the selected node's own frame, or the file's scene frame.
enum class NodeFrame { kOwn, kScene };

/// Loads the meshes of a glTF file (.gltf, .glb) by tinygltf. Mesh::files lists the files read.
///
/// Frames  glTF has y up; TERA has z up: p = (x, -z, y) of the file's coordinates. `node` selects a
///         node with its children; an empty name selects the whole scene.
/// Model   takes textures from `textures` if they are there; adds new ones to it.
/// Omits   skins, morph targets, cameras, lights.
/// Throws  InputError with the file and the fault. For an unknown node, it lists the existing ones.
Mesh LoadGltf(const std::filesystem::path& file, const std::string& node, Textures* textures,
              NodeFrame frame = NodeFrame::kOwn);

/// Loads the meshes of an OBJ, STL or DAE file by assimp. Coordinates stay unchanged: z up, in m.
///
/// Model   the base colour texture is the material's diffuse texture (map_Kd in an OBJ file's MTL).
/// Throws  InputError as in LoadGltf.
Mesh LoadWithAssimp(const std::filesystem::path& file, const std::string& node, Textures* textures,
                    NodeFrame frame = NodeFrame::kOwn);

/// Computes area-weighted normals from the triangles, for files without normals.
void ComputeNormals(MeshPart* part);

/// Normalises normals. Throws InputError if the mesh is empty or has an invalid index, position or
/// normal.
void FinishMesh(const std::filesystem::path& file, Mesh* mesh);

/// End of a message about an unknown node: " (did you mean 'a'?); it has: a, b, c".
std::string NodeHint(const std::string& wanted, const std::vector<std::string>& names);

}  // namespace tera
