#pragma once

#include <cstdint>

#include "core/types/measurement.h"
#include "render/gl/passes/full_screen.h"
#include "render/gl/passes/grain_renderer.h"
#include "render/gl/passes/lens.h"
#include "render/gl/passes/node_renderer.h"
#include "render/gl/pictures.h"
#include "render/gl/view.h"

namespace tera {

/// Draws the body image (body_picture.h): which body each pixel shows.
///
/// Model   draws the nodes again over the depth of a finished image and keeps pixels of equal
///         depth. Behind a lens, each pixel takes the nearest pixel of the pinhole image, as labels
///         do.
class BodyPass {
 public:
  /// Draws over the image of `view` in `p`. `nodes` and `grains` must be placed for it; `grains`
  /// may be null.
  void Draw(const View& view, const Pictures& p, const NodeRenderer& nodes,
            const GrainRenderer* grains);
  /// Reads the result of the last Draw.
  Image<std::uint16_t> Read() const;

  /// Clears the camera's image behind a lens.
  void ClearLens(int width_px, int height_px);
  /// Transfers the result of the last Draw into the camera's image; `view` is its index in
  /// Lens::views.
  void DrawLens(const Lens& lens, int view);
  Image<std::uint16_t> ReadLens() const;

 private:
  struct Target {
    int width_px = 0, height_px = 0;
    unsigned depth = 0;  ///< attached texture
    GlObject body, framebuffer;
  };
  static void Fit(int width_px, int height_px, unsigned depth, Target* target);

  Program program_{"node.vert", "body.frag"};
  Program lens_program_{"fullscreen.vert", "distort_body.frag"};
  FullScreen screen_;
  Target pinhole_, lens_;
};

}  // namespace tera
