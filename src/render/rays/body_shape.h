#pragma once

#include <vector>

#include "render/rays/embree_objects.h"
#include "render/scene.h"

namespace tera {

/// Meshes of one body B, or of several bodies that share one scene. A node places the geometry G of
/// one mesh in B.
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

/// A scene with watertight ray intersection between triangles.
EmbreeScene NewScene(RTCDevice device);

/// Adds the visible parts of the mesh `node`, an index into the body's nodes. Wet surfaces reflect
/// less, except glass and bare metal.
void AttachParts(RTCDevice device, const std::vector<MeshPart>& parts, int node, bool is_wet,
                 BodyShape* shape);

}  // namespace tera
