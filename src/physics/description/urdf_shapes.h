#pragma once

#include <urdf_model/link.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "physics/description/link_tree.h"

namespace tera {

/// Places to look for the meshes of a URDF. A relative path starts at the folder of the URDF.
/// `package://name/path` and Gazebo's `model://` use the folder from `packages`. Without an entry,
/// the folders above the URDF are searched for `path`, with and without the package's name.
struct UrdfMeshes {
  std::filesystem::path urdf;
  std::map<std::string, std::filesystem::path> packages;  ///< folders by package name
  AbsentMeshes absent = AbsentMeshes::kFault;
  std::vector<std::string> left_out = {};  ///< missing meshes, each listed once
};

Pose PoseOf(const urdf::Pose& pose);

/// Adds the visuals and collisions of a URDF link to `link`.
///
/// Model   Boxes, cylinders, spheres and mesh files become visuals. The colour of a material
///         applies to solids and to STL files, which have no colour. A mesh mirrored along one axis
///         equals a mesh mirrored along all three axes and rotated by half a turn. Each shape
///         collides by its bounding box; that of a mesh is aligned with the mesh frame.
/// Omits   Textures.
void AddUrdfShapes(const urdf::Link& in, const PartPlace& place, UrdfMeshes* meshes, Link* link);

}  // namespace tera
