#pragma once

#include <vector>

#include "render/rays/embree_objects.h"
#include "render/scene.h"

namespace tera {

/// Meshes of one body, or of several identical bodies.
struct BodyShape {
  std::vector<int> meshes;  ///< one per node; meshes, X_BG and scale identify identical shapes
  std::vector<Pose> X_BG;
  std::vector<double> scale;
  EmbreeScene scene;
  struct Part {
    int node;  ///< index in the body's list of nodes
    float reflectance, opacity;
  };
  std::vector<Part> parts;  ///< indexed by geometry id within `scene`

  bool Alike(const BodyShape& o) const;
};

/// A scene with watertight ray intersection between triangles.
EmbreeScene NewScene(RTCDevice device);

/// Adds the visible parts of the mesh `node`, an index into the body's nodes. Wet surfaces reflect
/// less, except glass and bare metal.
void AttachParts(RTCDevice device, const std::vector<MeshPart>& parts, int node, bool is_wet,
                 BodyShape* shape);

}  // namespace tera
