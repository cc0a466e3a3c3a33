#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/passes/daylight.h"
#include "render/gl/passes/full_screen.h"
#include "render/gl/passes/node_renderer.h"
#include "render/gl/pictures.h"
#include "render/gl/view.h"

namespace tera {

/// Adds to a shaded image: light of emissive surfaces, the sky behind surfaces, and glass in front
/// of them.
class SkyAndGlass {
 public:
  /// Draws into the radiance of `p`. Glass also writes labels and normals.
  void Draw(const View& view, const Daylight& daylight, const NodeRenderer& nodes,
            const Pictures& p) const;

 private:
  void AddOwnLight(const View& view, const Daylight& daylight, const NodeRenderer& nodes,
                   const Pictures& p) const;
  void DrawSky(const View& view, const Daylight& daylight, const Pictures& p) const;
  void DrawGlass(const View& view, const Daylight& daylight, const NodeRenderer& nodes,
                 const Pictures& p) const;

  Program own_light_{"node.vert", "emissive.frag"};
  Program sky_{"fullscreen.vert", "sky.frag"};
  Program glass_{"node.vert", "glass.frag"};
  Program glass_label_{"node.vert", "label.frag"};
  FullScreen screen_;
};

}  // namespace tera
