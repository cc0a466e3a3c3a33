#pragma once

#include <vector>

#include "render/rays/embree_objects.h"
#include "render/scene.h"

namespace tera {

/// Meshes of a body B in one Embree scene. Identical bodies share a shape. Each node places the
/// geometry G of a mesh in B.
struct BodyShape {
  std::vector<int> meshes;  ///< one per node, as labels, X_BG and scale
  std::vector<SemanticClass> labels;
  std::vector<Pose> X_BG;
  std::vector<double> scale;
  EmbreeScene scene;  ///< vertices in B, m
  struct Part {
    int node;  ///< index in the body's list of nodes
    float reflectance, opacity;
  };
  std::vector<Part> parts;  ///< indexed by geometry id within `scene`

  /// Whether meshes, labels, X_BG and scale are equal, so that one scene serves both bodies.
  bool Alike(const BodyShape& o) const;
};

/// A scene in which no ray passes between adjacent triangles.
EmbreeScene NewScene(RTCDevice device);

/// Adds the visible parts of a mesh. `node` is its index in the body's list of nodes. If `is_wet`,
/// surfaces other than glass and bare metal reflect less.
void AttachParts(RTCDevice device, const std::vector<MeshPart>& parts, int node, bool is_wet,
                 BodyShape* shape);

}  // namespace tera
