#pragma once

#include <urdf_model/link.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "physics/description/link_tree.h"

namespace tera {

/// Search folders for the meshes of a URDF. A relative path starts at the URDF. The form
/// `package://name/path`, like Gazebo's `model://`, uses the folder from `packages`. Without an
/// entry, the folders above the URDF are searched for `path`, with or without the package's name.
struct UrdfMeshes {
  std::filesystem::path urdf;
  std::map<std::string, std::filesystem::path> packages;  ///< folders by package name
  AbsentMeshes absent = AbsentMeshes::kFault;
  std::vector<std::string> left_out = {};  ///< missing meshes, without duplicates
};

Pose PoseOf(const urdf::Pose& pose);

/// Adds the visuals and collisions of a URDF link to `link`.
///
/// Model   boxes, cylinders, spheres and mesh files are visuals. A material's colour is a display
///         colour and applies to solids and to STL files, which have no colour. A mesh mirrored
///         along one axis equals a mesh mirrored along all three axes and rotated by half a turn.
///         For collision each shape is its bounding box; a mesh's box is aligned with the mesh
///         frame.
/// Omits   textures.
void AddUrdfShapes(const urdf::Link& in, const PartPlace& place, UrdfMeshes* meshes, Link* link);

}  // namespace tera
