#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/passes/grain_renderer.h"
#include "render/gl/passes/node_renderer.h"
#include "render/gl/pictures.h"
#include "render/gl/view.h"
#include "render/ground/terrain_renderer.h"

namespace tera {

/// Draws albedo, normal, label and depth of the nearest opaque surface in each pixel.
class GeometryPass {
 public:
  /// Clears the image and draws the nodes, which are placed for `view`.
  void DrawNodes(const View& view, const NodeRenderer& nodes, const Pictures& p) const;
  /// Adds the ground and the clods above it.
  void DrawGround(const View& view, const TerrainRenderer& terrain,
                  const GrainRenderer& grains) const;

 private:
  Program plain_{"node.vert", "node.frag"};
  Program textured_{"node.vert", "node.frag", {"TEXTURED"}};
};

}  // namespace tera
