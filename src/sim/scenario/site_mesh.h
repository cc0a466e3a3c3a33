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

/// A part of a site's mesh that is seen as it is: a wall, a building.
///
/// Frames  W.
struct SiteMeshPart {
  std::string name;  ///< of its instance
  SemanticClass label = SemanticClass::kStructure;
  bool is_solid = true;  ///< machines collide with it
  Mesh mesh;
};

/// A real place as a mesh, what `environment.mesh` names.
///
/// Frames  W; the file's axes (glTF's y up turned to z up) placed by `xyz_m` and `rpy_deg`, after
///         `scale`.
/// Model   Parts stand as they are, with their textures. With `ground`, the top of a node (or of
///         all) is the ground before anything has moved: heights every `cell_m`, drawn in the
///         mesh's colours as long as it is undisturbed.
/// Omits   overhangs of the ground: what lies below its top is soil.
struct SiteMesh {
  std::vector<SiteMeshPart> parts;
  Textures textures;
  std::optional<GivenGround> ground;
  std::shared_ptr<const GroundPaint> paint;  ///< null without ground

  /// Triangles of all solid parts.
  SiteWalls Walls() const;
};

/// Reads `file`, `xyz_m`, `rpy_deg`, `scale`, `parts` and `ground`; null after a fault, which goes
/// to `config`. `terrain` says how much of the ground is the site, by `size_m`; without it, as much
/// about W's origin as the mesh has.
std::shared_ptr<const SiteMesh> ReadSiteMesh(const ConfigMap& config, const ConfigMap& terrain);

}  // namespace tera
