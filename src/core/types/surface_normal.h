#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/motion.h"
#include "core/types/measurement.h"

namespace tera {

/// Encoding of a unit vector in the three values of a pixel of CameraFrame::normal.
///
/// Frames  C optical frame: x right, y down, z forward.
/// Model   v = round(32767 (n + 1)), so n = v / 32767 - 1 to within 1.6e-5. A pixel without a
///         surface holds 0 0 0. No unit vector encodes to this value.
inline constexpr double kNormalScale = 32767.0;

std::array<std::uint16_t, 3> PixelOfNormal(const Vec3& n_C);

/// Unit normal at a pixel; nullopt if the pixel has no surface.
std::optional<Vec3> NormalAt(const Image<std::uint16_t>& normal, int x_px, int y_px);

}  // namespace tera
