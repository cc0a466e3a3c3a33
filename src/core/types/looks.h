#pragma once

#include "core/motion.h"

/// Appearance of parts that have no mesh file.

namespace tera {

enum class SolidForm { kBox, kSphere, kCylinder };

/// A simple solid centred at the origin of its frame. A cylinder's axis is z.
struct Solid {
  SolidForm form = SolidForm::kBox;
  Vec3 size_m = Vec3::Zero();  ///< edge lengths of the bounding box
};

/// Uniform colour of a part. The albedo is linear, not sRGB.
struct Paint {
  Vec3 albedo = Vec3(0.5, 0.5, 0.5);
  double opacity = 1.0;
};

/// Converts an sRGB colour in [0, 1] to linear paint.
///
/// Source  IEC 61966-2-1.
Paint PaintFromSrgb(const Vec3& rgb, double opacity);

}  // namespace tera
