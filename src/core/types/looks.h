#pragma once

#include "core/motion.h"

/// How parts look that no mesh file describes.

namespace tera {

enum class SolidForm { kBox, kSphere, kCylinder };

/// A solid of simple form with its centre at the origin of its frame; a cylinder stands along z.
struct Solid {
  SolidForm form = SolidForm::kBox;
  Vec3 size_m = Vec3::Zero();  ///< edges of the box around it
};

/// Colour of a whole part, linear.
struct Paint {
  Vec3 albedo = Vec3(0.5, 0.5, 0.5);
  double opacity = 1.0;
};

/// Paint that a screen shows as the sRGB colour (red, green, blue) of 0..1.
///
/// Source  IEC 61966-2-1.
Paint PaintFromSrgb(const Vec3& rgb, double opacity);

}  // namespace tera
