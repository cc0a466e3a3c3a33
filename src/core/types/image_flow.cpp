#include "core/types/image_flow.h"

#include <cmath>
#include <optional>

namespace tera {
namespace {

constexpr double kMiddle = 32768, kPerPixel = 64, kPerMetre = 1000;

/// Pixel value, or nullopt out of range; 0 is reserved for "unknown".
std::optional<std::uint16_t> ValueOf(double scaled) {
  const double value = std::round(scaled + kMiddle);
  if (!(value >= 1 && value <= 65535)) return std::nullopt;
  return static_cast<std::uint16_t>(value);
}

}  // namespace

std::array<std::uint16_t, 3> PixelOfFlow(const Vec2& flow_px, FlowState state) {
  const auto u = ValueOf(kPerPixel * flow_px.x()), v = ValueOf(kPerPixel * flow_px.y());
  if (!u || !v || state == FlowState::kUnknown) return {0, 0, 0};
  return {*u, *v, static_cast<std::uint16_t>(state)};
}

PixelFlow FlowAt(const Image<std::uint16_t>& flow, int x_px, int y_px) {
  const auto value = [&](int c) { return (flow.at(x_px, y_px, c) - kMiddle) / kPerPixel; };
  return {{value(0), value(1)}, static_cast<FlowState>(flow.at(x_px, y_px, 2))};
}

std::array<std::uint16_t, 3> PixelOfShift(const Vec3& d_C_m) {
  std::array<std::uint16_t, 3> pixel{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto value = ValueOf(kPerMetre * d_C_m[static_cast<Eigen::Index>(k)]);
    if (!value) return {0, 0, 0};
    pixel[k] = *value;
  }
  return pixel;
}

}  // namespace tera
