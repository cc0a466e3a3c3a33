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

/// A visible part of a site's mesh: a wall, a building.
///
/// Frames  W.
struct SiteMeshPart {
  std::string name;  ///< name of its instance
  SemanticClass label = SemanticClass::kStructure;
  bool is_solid = true;  ///< machines collide with it
  Mesh mesh;
};

/// A real place as a mesh, named by `environment.mesh`.
///
/// Frames  W; the file's axes (glTF's y up turned to z up) placed by `xyz_m` and `rpy_deg`, after
///         `scale`.
/// Model   Parts keep their shape and textures. With `ground`, the top of a node (or of the whole
///         mesh) is the initial ground: heights every `cell_m`, drawn in the mesh's colours until
///         disturbed.
/// Omits   overhangs of the ground: everything below its top is soil.
struct SiteMesh {
  std::vector<SiteMeshPart> parts;
  Textures textures;
  std::optional<GivenGround> ground;
  std::shared_ptr<const GroundPaint> paint;  ///< null without ground

  /// Triangles of all solid parts.
  SiteWalls Walls() const;
};

/// Reads `file`, `xyz_m`, `rpy_deg`, `scale`, `parts` and `ground`. A fault goes to `config` and
/// gives null. `size_m` of `terrain` is the size of the site; by default it is as large about W's
/// origin as the mesh.
std::shared_ptr<const SiteMesh> ReadSiteMesh(const ConfigMap& config, const ConfigMap& terrain);

}  // namespace tera
