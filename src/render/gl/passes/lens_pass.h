#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/passes/full_screen.h"
#include "render/gl/passes/lens.h"
#include "render/gl/pictures.h"

namespace tera {

/// From the pinhole pictures of a lens to the camera's own.
class LensPass {
 public:
  /// Begins a camera's own picture, with normals or without.
  void Clear(const LensPictures& to, bool normals) const;
  /// Fills what of it comes from view `view` of the lens, whose picture is `from`.
  void Draw(const Lens& lens, int view, bool normals, const Pictures& from,
            const LensPictures& to) const;

 private:
  Program program_{"fullscreen.vert", "distort.frag"};
  Program normals_program_{"fullscreen.vert", "distort.frag", {"NORMALS"}};
  FullScreen screen_;
};

}  // namespace tera
