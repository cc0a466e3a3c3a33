#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/motion.h"
#include "core/time.h"
#include "core/types/labels.h"

/// Sensor outputs and recorded samples, as plain data. `t_ns` is the time at which a measurement is
/// valid. `t_available_ns` is the earliest time at which a reader can receive it.

namespace tera {

/// Angular rate and specific force, expressed in the sensor frame S: x forward, y left, z up. A
/// level sensor at rest reads +g on z.
struct ImuSample {
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  Vec3 w_WS_S_radps = Vec3::Zero();
  Vec3 f_S_mps2 = Vec3::Zero();
};

/// Fix quality of the NMEA 0183 sentence GGA.
enum class GnssFix : std::uint8_t {
  kNone = 0,
  kSingle = 1,
  kDifferential = 2,
  kRtkFixed = 4,
  kRtkFloat = 5
};

/// Antenna position: WGS 84 latitude and longitude, height above the ellipsoid, and ENU coordinates
/// in the tangent plane at the site origin. With fix kNone, all values are 0 and invalid.
struct GnssSample {
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  double lat_deg = 0;
  double lon_deg = 0;
  double alt_m = 0;
  Vec3 enu_m = Vec3::Zero();
  GnssFix fix = GnssFix::kNone;
  Vec3 variance_enu_m2 = Vec3::Zero();
};

/// A measured joint: an angle, or the travel of a prismatic joint.
struct EncoderAxis {
  std::string name;
  bool linear = false;

  bool operator==(const EncoderAxis&) const = default;
};

/// Joint positions and rates, in the order of the sensor's joints. Prismatic joints use m and m/s
/// instead of rad and rad/s.
struct EncoderSample {
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  std::vector<double> q_rad;
  std::vector<double> qd_radps;
};

/// A row-major image with `channels` interleaved samples.
template <typename T>
struct Image {
  using Pixel = T;  ///< type of one channel

  int width_px = 0;
  int height_px = 0;
  int channels = 1;
  std::vector<T> data;

  Image() = default;
  Image(int width, int height, int channel_count = 1)
      : width_px(width),
        height_px(height),
        channels(channel_count),
        data(static_cast<std::size_t>(width) * height * channel_count) {}
  bool empty() const { return data.empty(); }
  const T& at(int x_px, int y_px, int c = 0) const {
    return data[(static_cast<std::size_t>(y_px) * width_px + x_px) * channels + c];
  }
  T& at(int x_px, int y_px, int c = 0) {
    return data[(static_cast<std::size_t>(y_px) * width_px + x_px) * channels + c];
  }
};

/// Visibility of a key point in an image.
enum class KeypointSight : std::uint8_t { kOutside = 0, kHidden = 1, kSeen = 2 };

/// A named point of an object, as one image shows it.
struct Keypoint {
  std::string name;
  Vec3 p_C_m = Vec3::Zero();     ///< in the camera optical frame
  std::optional<Vec2> pixel_px;  ///< may lie outside the image; absent if the point is behind the
                                 ///< camera
  KeypointSight sight = KeypointSight::kOutside;
};

/// Lighting and motion blur of an object in one image, as means over its visible pixels.
struct ObjectLight {
  double blur_px = 0;          ///< mean image motion during the exposure
  double most_blur_px = 0;     ///< largest image motion during the exposure
  double luminance_cdpm2 = 0;  ///< luminance towards the camera, before lens losses
  double illuminance_lx = 0;   ///< illuminance of the surface by sun, sky and lamps
  double shadow = 0;           ///< fraction of pixels without direct sunlight; 1 if there is no sun
};

/// A labelled object in one image.
///
/// Frames  `X_CO` is the pose of the object's box frame O in the camera optical frame C (x right, y
///         down, z forward). O's origin is the box centre; `size_O_m` is the box's edge lengths
///         along O's axes.
struct ObjectBox {
  std::uint16_t instance = 0;
  std::uint16_t parent = 0;  ///< instance of the object that this object is a part of; 0 for none
  SemanticClass label = SemanticClass::kSky;
  std::string name;
  int x_min_px = 0, y_min_px = 0;  ///< bounds of the visible pixels, inclusive
  int x_max_px = -1, y_max_px = -1;
  std::int64_t visible_px = 0;
  /// Visible pixels divided by the pixels that the object would cover in this image without
  /// occluders.
  double visibility = 0;
  /// Bounds of the object without occluders and without the image border. Pixel centres have
  /// integer coordinates.
  Vec2 amodal_min_px = Vec2::Zero(), amodal_max_px = Vec2::Zero();
  double truncation = 0;  ///< fraction of the area within the amodal bounds that lies outside the
                          ///< image
  Pose X_CO = Pose::Identity();
  Vec3 size_O_m = Vec3::Zero();
  std::vector<Keypoint> keypoints;
  std::optional<ObjectLight> light;  ///< only with the camera's light labels
};

/// Camera settings of one image.
struct PictureExposure {
  double exposure_s = 0, f_number = 0, gain_db = 0;
  double saturation_cdpm2 = 0;  ///< on-axis scene luminance that saturates the green channel
  Vec3 balance = Vec3::Ones();  ///< white balance gains of red, green and blue
};

/// Load of one shovel at the time of an image, even if the image does not show it.
struct CarriedLoad {
  std::uint16_t instance = 0;  ///< instance number of the load's soil in the instance image
  std::string name;
  std::int64_t visible_px = 0;
  double volume_m3 = 0, mass_kg = 0;
  double fill = 0;                      ///< volume divided by the shovel's heaped capacity
  std::optional<double> released_kgps;  ///< rate of soil loss since the previous image; absent
                                        ///< without one
};

/// One exposure. All images have the same pixel grid. An image that the camera does not produce is
/// empty.
struct CameraFrame {
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  Image<std::uint8_t> rgb;        ///< 3 channels, sRGB
  Image<float> depth_m;           ///< depth along z of C, not along the ray; 0: no measurement
  Image<std::uint8_t> semantic;   ///< SemanticClass
  Image<std::uint16_t> instance;  ///< 0: none; otherwise the instance number in dataset.yaml
  Image<std::uint16_t> normal;    ///< 3 channels, encoded as in surface_normal.h
  Image<std::uint16_t> distance;  ///< exact distance along the ray to the camera centre:
                                  ///< PixelOfDistance
  /// Optical flow between this image and the previous image. flow_to_previous is defined on this
  /// image's pixels, flow_to_this on the previous image's pixels. 3 channels encoded by
  /// PixelOfFlow; all 0 in the first image.
  Image<std::uint16_t> flow_to_previous, flow_to_this;
  Image<std::uint16_t> scene_flow_to_previous;  ///< 3 channels encoded by PixelOfShift; all 0 in
                                                ///< the first image
  Image<std::uint8_t> ground_soil;              ///< encoded by PixelOfSoil
  Image<std::uint8_t> ground_state;  ///< looseness, moisture and rut as in TerrainSurface::Cover
  Image<std::uint16_t> ground_change, ground_age;  ///< encoded by PixelOfRise and PixelOfAge
  Image<std::uint16_t> dust_optical_depth;         ///< encoded by PixelOfOpticalDepth
  Image<std::uint8_t> lens_soiling;                ///< transmittance of the lens, in 1/255
  Image<std::uint8_t> panoptic;        ///< 3 channels: class, instance mod 256, instance / 256
  Image<std::uint8_t> soil_in_flight;  ///< 255 where a clod flies or rolls down a slope; else 0
  std::vector<ObjectBox> boxes;
  std::optional<PictureExposure> exposure;  ///< only with the camera's exposure labels
  std::vector<CarriedLoad> loads;           ///< only with the camera's load labels
};

/// One lidar return, in the sensor frame at the time the ray was emitted.
struct LidarPoint {
  float x_m = 0, y_m = 0, z_m = 0;
  float intensity = 0;               ///< relative reflectivity, in [0, 1]
  std::uint32_t time_offset_ns = 0;  ///< time since the scan's t_ns
  std::uint16_t ring = 0;
  std::uint16_t instance = 0;
  std::uint8_t label = 0;  ///< SemanticClass
};

/// One revolution. t_ns is the time of its first ray. A ray without a return has no point.
struct LidarScan {
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  std::vector<LidarPoint> points;
};

/// True pose and velocity of a machine's root link.
struct TruthPose {
  TimeNs t_ns = 0;
  Pose X_WB = Pose::Identity();
  Vec3 v_WB_mps = Vec3::Zero();
  Vec3 w_WB_B_radps = Vec3::Zero();
};

/// Numeric values at one instant, for low-dimensional sensors (sample_rows.h) and ground-truth
/// tables. The channel stores the column names.
struct RowSample {
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  std::vector<double> values;
};

/// Any message that a sensor channel carries.
using Measurement = std::variant<RowSample, CameraFrame, LidarScan>;

}  // namespace tera
