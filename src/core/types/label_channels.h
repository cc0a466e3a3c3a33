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

/// Ground-truth images that a camera may produce in addition to colour and depth, as one table.
/// Cameras, the rasterizer, datasets, overviews and the live interfaces iterate over it.

namespace tera {

/// Source of a channel.
enum class LabelSource {
  kLabelWord,      ///< bit range of a 32-bit word that a shader writes per pixel
  kSurfaceNormal,  ///< RGBA16 that a shader writes: n / 2 + 1/2 in W; all 0 without a surface
  kSurfaces,       ///< computed by the camera from depth, bodies, ground and earlier images
  kAir,            ///< computed by the camera from depth and airborne particles
  kOptics          ///< from the camera's lens and glass
};

/// Colour map of a channel in overviews.
enum class LabelColours {
  kClasses,     ///< colours of SemanticClass
  kPanoptic,    ///< colour of the instance, or of the SemanticClass without an instance
  kNumbers,     ///< distinct numbers have distinct colours
  kDirections,  ///< three components as red, green and blue
  kFlow,        ///< hue by direction, strength by length
  kNearness,    ///< warm for small values, 0 black
  kRise         ///< red above 32768, blue below it, 0 black
};

/// Image of the frame. Its pixel type is also the type of the PNG file.
using LabelPicture =
    std::variant<Image<std::uint8_t> CameraFrame::*, Image<std::uint16_t> CameraFrame::*>;

struct LabelChannel {
  std::string_view name;  ///< key in the camera's `labels`, dataset folder and ROS topic
  LabelPicture picture;
  int components;  ///< 1: grey; 3: RGB
  bool is_usual;   ///< included in `labels: true`
  LabelSource source;
  int first_bit;  ///< offset in the label word
  LabelColours colours;
  std::string_view caption;  ///< caption in the overview
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

/// Set of channels by table index.
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

/// Table index of a channel.
inline std::size_t IndexOf(const LabelChannel& channel) {
  return static_cast<std::size_t>(&channel - kLabelChannels.data());
}

/// Calls `visit(channel, picture)` for each channel, including empty images.
template <typename Frame, typename Visit>
void ForEachLabel(Frame& frame, const Visit& visit) {
  for (const LabelChannel& channel : kLabelChannels) {
    std::visit([&](const auto picture) { visit(channel, frame.*picture); }, channel.picture);
  }
}

/// Bytes of one component of a pixel.
inline std::size_t ComponentBytes(const LabelChannel& channel) {
  return std::visit(
      [](const auto picture) {
        return sizeof(typename std::remove_reference_t<decltype(std::declval<CameraFrame>().*
                                                                picture)>::Pixel);
      },
      channel.picture);
}

}  // namespace tera
