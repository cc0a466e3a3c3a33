#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/motion.h"
#include "core/types/measurement.h"

namespace tera {

/// A unit vector as the three values of a pixel of CameraFrame::normal.
///
/// Frames  C, the optical frame: x right, y down, z forward.
/// Model   v = round(32767 (n + 1)), so that n = v / 32767 - 1 to within 1.6e-5; 0 0 0, which no
///         unit vector gives, where no surface is.
inline constexpr double kNormalScale = 32767.0;

std::array<std::uint16_t, 3> PixelOfNormal(const Vec3& n_C);

/// The normal at a pixel, of length 1, or nothing where no surface is.
std::optional<Vec3> NormalAt(const Image<std::uint16_t>& normal, int x_px, int y_px);

}  // namespace tera
