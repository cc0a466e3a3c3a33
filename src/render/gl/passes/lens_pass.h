#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/passes/full_screen.h"
#include "render/gl/passes/lens.h"
#include "render/gl/pictures.h"

namespace tera {

/// Resamples the pinhole images of a lens to the camera's image.
class LensPass {
 public:
  /// Clears the camera's image. `normals` includes the normals.
  void Clear(const LensPictures& to, bool normals) const;
  /// Fills those pixels that Lens::views[view] supplies, from its image `from`.
  void Draw(const Lens& lens, int view, bool normals, const Pictures& from,
            const LensPictures& to) const;

 private:
  Program program_{"fullscreen.vert", "distort.frag"};
  Program normals_program_{"fullscreen.vert", "distort.frag", {"NORMALS"}};
  FullScreen screen_;
};

}  // namespace tera
