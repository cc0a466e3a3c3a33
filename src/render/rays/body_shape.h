#pragma once

#include <vector>

#include "render/rays/embree_objects.h"
#include "render/scene.h"

namespace tera {

/// The meshes of one body, or of several bodies that look alike.
struct BodyShape {
  std::vector<int> meshes;  ///< of each node, with X_BG and scale: what makes shapes alike
  std::vector<Pose> X_BG;
  std::vector<double> scale;
  EmbreeScene scene;
  struct Part {
    int node;  ///< place in the body's list of nodes
    float reflectance, opacity;
  };
  std::vector<Part> parts;  ///< by geometry id within `scene`

  bool Alike(const BodyShape& o) const;
};

/// A scene in which rays find their way between triangles without gaps.
EmbreeScene NewScene(RTCDevice device);

/// Adds what can be hit of `parts`, the mesh at place `node` of the body's nodes; surfaces
/// that are wet reflect less, glass and bare metal excepted.
void AttachParts(RTCDevice device, const std::vector<MeshPart>& parts, int node, bool is_wet,
                 BodyShape* shape);

}  // namespace tera
