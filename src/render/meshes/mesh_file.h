#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/meshes/mesh.h"

namespace tera {

/// Whether a node's mesh comes in the node's own frame or where the file's scene has it.
enum class NodeFrame { kOwn, kScene };

/// Meshes of a glTF file (.gltf, .glb), by tinygltf. Both loaders name the files they read.
///
/// Frames  glTF has y up; our frames have z up: p = (x, -z, y) of the file's numbers. With a node
///         name, the node and its children in `frame`; without, the whole scene.
/// Model   Textures come from `textures` where they are there already, and are put there.
/// Omits   skins, morph targets, cameras, lights.
/// Throws  InputError naming the file, what is wrong and, for an unknown node, the nodes there are.
Mesh LoadGltf(const std::filesystem::path& file, const std::string& node, Textures* textures,
              NodeFrame frame = NodeFrame::kOwn);

/// Meshes of OBJ, STL or DAE files, by assimp; z up, metres, as they are.
///
/// Model   of textures, a material's diffuse one (map_Kd of an OBJ file's MTL) is its base colour.
/// Throws  InputError as LoadGltf does.
Mesh LoadWithAssimp(const std::filesystem::path& file, const std::string& node, Textures* textures,
                    NodeFrame frame = NodeFrame::kOwn);

/// Sets normals of `part` from its triangles, weighted by area, where the file has none.
void ComputeNormals(MeshPart* part);

/// Throws InputError unless every index, position and normal can be drawn and the mesh is not
/// empty; makes normals unit length.
void FinishMesh(const std::filesystem::path& file, Mesh* mesh);

/// " (did you mean 'a'?); it has: a, b, c".
std::string NodeHint(const std::string& wanted, const std::vector<std::string>& names);

}  // namespace tera
