#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/meshes/mesh.h"

namespace tera {

/// Frame of a node's mesh: the node's own frame, or the file's scene frame.
enum class NodeFrame { kOwn, kScene };

/// Loads the meshes of a glTF file (.gltf, .glb) by tinygltf. Both loaders record the files they
/// read.
///
/// Frames  glTF has y up; TERA frames have z up: p = (x, -z, y) of the file's coordinates. A node
///         name selects the node and its children in `frame`; an empty name selects the whole
///         scene.
/// Model   textures in `textures` are reused; new textures are added to it.
/// Omits   skins, morph targets, cameras, lights.
/// Throws  InputError with the file and the fault; for an unknown node also the existing nodes.
Mesh LoadGltf(const std::filesystem::path& file, const std::string& node, Textures* textures,
              NodeFrame frame = NodeFrame::kOwn);

/// Loads the meshes of OBJ, STL or DAE files by assimp; z up, metres, unchanged coordinates.
///
/// Model   the base colour texture is the material's diffuse texture (map_Kd in an OBJ file's MTL).
/// Throws  InputError as in LoadGltf.
Mesh LoadWithAssimp(const std::filesystem::path& file, const std::string& node, Textures* textures,
                    NodeFrame frame = NodeFrame::kOwn);

/// Computes area-weighted normals from the triangles of `part`, for files without normals.
void ComputeNormals(MeshPart* part);

/// Normalizes normals. Throws InputError if the mesh is empty or has an invalid index, position or
/// normal.
void FinishMesh(const std::filesystem::path& file, Mesh* mesh);

/// " (did you mean 'a'?); it has: a, b, c".
std::string NodeHint(const std::string& wanted, const std::vector<std::string>& names);

}  // namespace tera
