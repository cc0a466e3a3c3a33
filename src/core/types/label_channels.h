#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/types/measurement.h"

/// Table of the ground-truth images that a camera can produce besides colour and depth. Cameras,
/// rasterizer, dataset writers, overviews and live interfaces iterate over this table.

namespace tera {

/// Source of a channel.
enum class LabelSource {
  kLabelWord,      ///< a range of bits in a 32-bit word that a shader writes per pixel
  kSurfaceNormal,  ///< a shader writes RGBA16: n / 2 + 1/2 in W; all zero without a surface
  kSurfaces,       ///< the camera computes it from depth, bodies, ground and earlier images
  kAir,            ///< the camera computes it from depth and airborne particles
  kOptics          ///< the camera computes it from its lens and the soiling of the glass
};

/// Colour scheme of a channel in overview images.
enum class LabelColours {
  kClasses,     ///< colours of SemanticClass
  kPanoptic,    ///< colour by instance; by SemanticClass where a pixel has no instance
  kNumbers,     ///< a distinct colour for each number
  kDirections,  ///< three components as red, green and blue
  kFlow,        ///< hue shows direction; saturation shows length
  kNearness,    ///< warm colours for small values; black for 0
  kRise         ///< red above 32768, blue below, black for 0
};

/// Pointer to the image in CameraFrame. The PNG file has the same pixel type.
using LabelPicture =
    std::variant<Image<std::uint8_t> CameraFrame::*, Image<std::uint16_t> CameraFrame::*>;

struct LabelChannel {
  std::string_view name;  ///< key in the camera's `labels`, dataset folder and ROS topic
  LabelPicture picture;
  int components;  ///< 1: grey; 3: RGB
  bool is_usual;   ///< produced by the setting `labels: true`
  LabelSource source;
  int first_bit;  ///< offset in the label word
  LabelColours colours;
  std::string_view caption;
};

inline constexpr std::array<LabelChannel, 15> kLabelChannels = {{
    {"semantic", &CameraFrame::semantic, 1, true, LabelSource::kLabelWord, 0,
     LabelColours::kClasses, "classes"},
    {"instance", &CameraFrame::instance, 1, true, LabelSource::kLabelWord, 8,
     LabelColours::kNumbers, "instances"},
    {"normal", &CameraFrame::normal, 3, false, LabelSource::kSurfaceNormal, 0,
     LabelColours::kDirections, "normals"},
    {"distance", &CameraFrame::distance, 1, false, LabelSource::kSurfaces, 0,
     LabelColours::kNearness, "distance along the ray"},
    {"flow_to_previous", &CameraFrame::flow_to_previous, 3, false, LabelSource::kSurfaces, 0,
     LabelColours::kFlow, "flow to the previous picture"},
    {"flow_to_this", &CameraFrame::flow_to_this, 3, false, LabelSource::kSurfaces, 0,
     LabelColours::kFlow, "flow from the previous picture"},
    {"scene_flow_to_previous", &CameraFrame::scene_flow_to_previous, 3, false,
     LabelSource::kSurfaces, 0, LabelColours::kDirections, "scene flow to the previous picture"},
    {"ground_soil", &CameraFrame::ground_soil, 1, false, LabelSource::kSurfaces, 0,
     LabelColours::kNumbers, "soil"},
    {"ground_state", &CameraFrame::ground_state, 3, false, LabelSource::kSurfaces, 0,
     LabelColours::kDirections, "loose, wet, rutted"},
    {"ground_change", &CameraFrame::ground_change, 1, false, LabelSource::kSurfaces, 0,
     LabelColours::kRise, "cut and fill"},
    {"ground_age", &CameraFrame::ground_age, 1, false, LabelSource::kSurfaces, 0,
     LabelColours::kNearness, "time since touched"},
    {"dust_optical_depth", &CameraFrame::dust_optical_depth, 1, false, LabelSource::kAir, 0,
     LabelColours::kNearness, "optical depth of dust"},
    {"lens_soiling", &CameraFrame::lens_soiling, 1, false, LabelSource::kOptics, 0,
     LabelColours::kNearness, "light through the soiled glass"},
    {"panoptic", &CameraFrame::panoptic, 3, false, LabelSource::kLabelWord, 0,
     LabelColours::kPanoptic, "classes and instances"},
    {"soil_in_flight", &CameraFrame::soil_in_flight, 1, false, LabelSource::kSurfaces, 0,
     LabelColours::kNumbers, "soil in flight"},
}};

/// Set of channels. A bit's position is the channel's index in kLabelChannels.
using LabelSet = std::bitset<kLabelChannels.size()>;

inline constexpr std::size_t kSemanticChannel = 0, kInstanceChannel = 1, kNormalChannel = 2,
                             kDistanceChannel = 3, kFlowToPreviousChannel = 4,
                             kFlowToThisChannel = 5, kSceneFlowToPreviousChannel = 6,
                             kGroundSoilChannel = 7, kGroundStateChannel = 8,
                             kGroundChangeChannel = 9, kGroundAgeChannel = 10, kDustChannel = 11,
                             kLensSoilingChannel = 12, kSoilInFlightChannel = 14;

inline LabelSet UsualLabels() {
  LabelSet usual;
  for (std::size_t k = 0; k < usual.size(); ++k) usual[k] = kLabelChannels[k].is_usual;
  return usual;
}

inline std::size_t IndexOf(const LabelChannel& channel) {
  return static_cast<std::size_t>(&channel - kLabelChannels.data());
}

/// Calls `visit(channel, image)` for every channel, even if its image is empty.
template <typename Frame, typename Visit>
void ForEachLabel(Frame& frame, const Visit& visit) {
  for (const LabelChannel& channel : kLabelChannels) {
    std::visit([&](const auto picture) { visit(channel, frame.*picture); }, channel.picture);
  }
}

/// Bytes per component of a pixel.
inline std::size_t ComponentBytes(const LabelChannel& channel) {
  return std::visit(
      [](const auto picture) {
        return sizeof(typename std::remove_reference_t<decltype(std::declval<CameraFrame>().*
                                                                picture)>::Pixel);
      },
      channel.picture);
}

}  // namespace tera
