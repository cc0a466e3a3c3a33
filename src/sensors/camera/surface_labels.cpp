#include "sensors/camera/surface_labels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/time.h"
#include "render/gl/body_picture.h"

namespace tera {
namespace {

/// Soil index plus 1; 0 outside the ground of the site.
std::uint8_t PixelOfSoil(std::uint8_t soil) {
  return static_cast<std::uint8_t>(std::min(soil + 1, 255));
}

/// Rise of the surface in millimetres plus 32768, limited to +-32.767 m; 0 outside the ground of
/// the site.
std::uint16_t PixelOfRise(double risen_m) {
  constexpr double kMiddle = 32768, kPerMetre = 1000;
  return static_cast<std::uint16_t>(
      std::clamp(std::round(kMiddle + kPerMetre * risen_m), 1.0, 65535.0));
}

/// Time since the ground was touched, in tenths of a second plus 1, at most 65534. 65535 means
/// never, 0 outside the ground of the site.
std::uint16_t PixelOfAge(std::optional<TimeNs> untouched_ns) {
  constexpr TimeNs kStep_ns = kNsPerSecond / 10, kLongest = 65534, kNever = 65535;
  if (!untouched_ns) return kNever;
  return static_cast<std::uint16_t>(
      std::min((*untouched_ns + kStep_ns / 2) / kStep_ns + 1, kLongest));
}

/// Whole millimetres; 0: no surface, or beyond 65.535 m.
std::uint16_t PixelOfDistance(double distance_m) {
  constexpr double kPerMetre = 1000, kLargest = 65535;
  const double value = std::round(kPerMetre * distance_m);
  return value <= kLargest ? static_cast<std::uint16_t>(value) : std::uint16_t{0};
}

}  // namespace

SurfaceLabels::SurfaceLabels(const CameraIntrinsics& lens, LabelSet labels) : labels_(labels) {
  for (const LabelChannel& channel : kLabelChannels) {
    if (labels[IndexOf(channel)] && channel.source == LabelSource::kSurfaces) any_ = true;
  }
  flows_ =
      Has(kFlowToPreviousChannel) || Has(kFlowToThisChannel) || Has(kSceneFlowToPreviousChannel);
  ages_ = Has(kGroundChangeChannel) || Has(kGroundAgeChannel);
  if (any_) rays_.emplace(lens);
}

void SurfaceLabels::FillFlows(SeenSurfaces now, CameraFrame* frame) {
  const int width = rays_->lens().width_px, height = rays_->lens().height_px;
  const auto picture = [&](std::size_t channel, Image<std::uint16_t>* of_frame) {
    if (!Has(channel)) return static_cast<Image<std::uint16_t>*>(nullptr);
    *of_frame = Image<std::uint16_t>(width, height, 3);
    return before_ ? of_frame : nullptr;
  };
  Image<std::uint16_t>* back = picture(kFlowToPreviousChannel, &frame->flow_to_previous);
  Image<std::uint16_t>* shift =
      picture(kSceneFlowToPreviousChannel, &frame->scene_flow_to_previous);
  Image<std::uint16_t>* here = picture(kFlowToThisChannel, &frame->flow_to_this);
  if (back != nullptr || shift != nullptr) FlowBetween(*rays_, now, *before_, back, shift);
  if (here != nullptr) FlowBetween(*rays_, *before_, now, here, nullptr);
  before_ = std::move(now);
}

void SurfaceLabels::FillGround(const SeenSurfaces& now, CameraFrame* frame) const {
  const int width = rays_->lens().width_px, height = rays_->lens().height_px;
  if (Has(kGroundSoilChannel)) frame->ground_soil = Image<std::uint8_t>(width, height);
  if (Has(kGroundStateChannel)) frame->ground_state = Image<std::uint8_t>(width, height, 3);
  if (Has(kGroundChangeChannel)) frame->ground_change = Image<std::uint16_t>(width, height);
  if (Has(kGroundAgeChannel)) frame->ground_age = Image<std::uint16_t>(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double depth_m = now.depth_m.at(x, y);
      if (now.body.at(x, y) != kNoBody || !(depth_m > 0)) continue;
      const Vec3 p_W_m = now.X_WC * (depth_m * rays_->at(x, y));
      const auto state = ground_.At(p_W_m.x(), p_W_m.y());
      if (!state) continue;
      const TerrainSurface::Cover& cover = state->cover;
      if (Has(kGroundSoilChannel)) frame->ground_soil.at(x, y) = PixelOfSoil(cover.soil);
      if (Has(kGroundStateChannel)) {
        frame->ground_state.at(x, y, 0) = cover.looseness;
        frame->ground_state.at(x, y, 1) = cover.moisture;
        frame->ground_state.at(x, y, 2) = cover.rut;
      }
      if (Has(kGroundChangeChannel)) frame->ground_change.at(x, y) = PixelOfRise(state->risen_m);
      if (Has(kGroundAgeChannel)) frame->ground_age.at(x, y) = PixelOfAge(state->untouched_ns);
    }
  }
}

void SurfaceLabels::FillFlight(const SeenSurfaces& now, CameraFrame* frame) const {
  frame->soil_in_flight = Image<std::uint8_t>(now.body.width_px, now.body.height_px);
  std::ranges::transform(now.body.data, frame->soil_in_flight.data.begin(), [](std::uint16_t body) {
    return static_cast<std::uint8_t>(body == kSoilInFlight ? 255 : 0);
  });
}

void SurfaceLabels::FillDistance(const SeenSurfaces& now, CameraFrame* frame) const {
  frame->distance = Image<std::uint16_t>(now.depth_m.width_px, now.depth_m.height_px);
  for (int y = 0; y < now.depth_m.height_px; ++y) {
    for (int x = 0; x < now.depth_m.width_px; ++x) {
      frame->distance.at(x, y) = PixelOfDistance(now.depth_m.at(x, y) * rays_->at(x, y).norm());
    }
  }
}

void SurfaceLabels::Fill(const SeenScene& scene, const Image<float>& depth_m,
                         const Image<std::uint16_t>& body, CameraFrame* frame) {
  if (!any_) return;
  SeenSurfaces now{scene.X_WC, scene.state.X_WB, depth_m, body};
  const bool has_ground = scene.state.terrain != nullptr;
  if (has_ground) ground_.Advance(*scene.state.terrain, scene.state.t_ns);
  if (has_ground && (Has(kGroundSoilChannel) || Has(kGroundStateChannel) || ages_)) {
    FillGround(now, frame);
  }
  if (Has(kSoilInFlightChannel)) FillFlight(now, frame);
  if (Has(kDistanceChannel)) FillDistance(now, frame);
  if (flows_) FillFlows(std::move(now), frame);
}

}  // namespace tera
