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

/// Draws which body each pixel shows (body_picture.h).
///
/// Model   the nodes once more over a finished picture's depth, each pixel kept where the node is
///         what the depth is of; behind a lens the nearest pixel's, as for labels.
class BodyPass {
 public:
  /// Over the picture of `view` in `p`, for which nodes and grains, if any, were placed.
  void Draw(const View& view, const Pictures& p, const NodeRenderer& nodes,
            const GrainRenderer* grains);
  /// What Draw gave last, read.
  Image<std::uint16_t> Read() const;

  /// Begins a camera's own picture behind a lens.
  void ClearLens(int width_px, int height_px);
  /// Takes what Draw gave last as view `view` of the lens.
  void DrawLens(const Lens& lens, int view);
  Image<std::uint16_t> ReadLens() const;

 private:
  struct Target {
    int width_px = 0, height_px = 0;
    unsigned depth = 0;  ///< texture that is attached
    GlObject body, framebuffer;
  };
  static void Fit(int width_px, int height_px, unsigned depth, Target* target);

  Program program_{"node.vert", "body.frag"};
  Program lens_program_{"fullscreen.vert", "distort_body.frag"};
  FullScreen screen_;
  Target pinhole_, lens_;
};

}  // namespace tera
