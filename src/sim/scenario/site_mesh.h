#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/types/labels.h"
#include "physics/dynamics/site_walls.h"
#include "render/ground/ground_paint.h"
#include "render/meshes/mesh.h"
#include "soil/site/given_ground.h"

namespace tera {

/// A visible part of a site's mesh, such as a wall or a building.
///
/// Frames  W.
struct SiteMeshPart {
  std::string name;  ///< name of its instance
  SemanticClass label = SemanticClass::kStructure;
  bool is_solid = true;  ///< machines collide with it
  Mesh mesh;
};

/// A mesh of a real place, from `environment.mesh`.
///
/// Frames  W. The file's axes (after glTF's y up is turned to z up) are scaled by `scale`, then
///         placed by `xyz_m` and `rpy_deg`.
/// Model   parts keep their shape and textures. With the key `ground`, the upper surface of a node,
///         or of the whole mesh, becomes the initial ground. Its heights are sampled every
///         `cell_m`. It has the colours of the mesh until it is disturbed.
/// Omits   overhangs of the ground: everything below the upper surface is soil.
struct SiteMesh {
  std::vector<SiteMeshPart> parts;
  Textures textures;
  std::optional<GivenGround> ground;
  std::shared_ptr<const GroundPaint> paint;  ///< null without ground

  /// Triangles of all solid parts.
  SiteWalls Walls() const;
};

/// Reads the keys `file`, `xyz_m`, `rpy_deg`, `scale`, `parts` and `ground`. After a fault, which
/// goes to `config`, the result is null. `size_m` of `terrain` is the size of the site. By default
/// the site is the largest rectangle around the origin of W that the mesh covers.
std::shared_ptr<const SiteMesh> ReadSiteMesh(const ConfigMap& config, const ConfigMap& terrain);

}  // namespace tera
