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

/// Sensor outputs and recorded samples: plain data without behaviour. `t_ns` is the time of
/// validity of a measurement; `t_available_ns` is the earliest time at which a reader could have
/// it.

namespace tera {

/// Angular rate and specific force, expressed in the sensor frame S: x forward, y left, z up. A
/// level sensor at rest reads +g on z.
struct ImuSample {
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  Vec3 w_WS_S_radps = Vec3::Zero();
  Vec3 f_S_mps2 = Vec3::Zero();
};

/// Fix quality as in the GGA sentence of NMEA 0183.
enum class GnssFix : std::uint8_t {
  kNone = 0,
  kSingle = 1,
  kDifferential = 2,
  kRtkFixed = 4,
  kRtkFloat = 5
};

/// Antenna position. Latitude and longitude are on WGS 84, with height above the ellipsoid. ENU is
/// relative to the site origin, in its tangent plane. With fix kNone all values are 0 and invalid.
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

/// Joint positions and rates in the order of the sensor's joints; metres for prismatic joints.
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

/// A named point of an object in one image.
struct Keypoint {
  std::string name;
  Vec3 p_C_m = Vec3::Zero();     ///< in the camera optical frame
  std::optional<Vec2> pixel_px;  ///< may lie beyond the image; none behind the camera
  KeypointSight sight = KeypointSight::kOutside;
};

/// Light and motion blur of an object in one image: means over its visible pixels.
struct ObjectLight {
  double blur_px = 0;          ///< image motion of its points during the exposure
  double most_blur_px = 0;     ///< longest image motion
  double luminance_cdpm2 = 0;  ///< towards the camera, in front of its lens
  double illuminance_lx = 0;   ///< on its surface, from sun, sky and lamps
  double shadow = 0;           ///< fraction without direct sunlight; 1 without a sun
};

/// A labelled object in one image.
///
/// Frames  `X_CO` is the pose of the object's box frame O in the camera optical frame C (x right, y
///         down, z forward). O's origin is the box centre; `size_O_m` is the box's edge lengths
///         along O's axes.
struct ObjectBox {
  std::uint16_t instance = 0;
  std::uint16_t parent = 0;  ///< instance of the whole that contains this part; 0: no parent
  SemanticClass label = SemanticClass::kSky;
  std::string name;
  int x_min_px = 0, y_min_px = 0;  ///< visible pixels, inclusive
  int x_max_px = -1, y_max_px = -1;
  std::int64_t visible_px = 0;
  /// Visible pixels over the pixels that the object would cover without occluders in this image, in
  /// [0, 1].
  double visibility = 0;
  /// Amodal box on an unbounded image, without occluders; pixel centres have integer coordinates.
  Vec2 amodal_min_px = Vec2::Zero(), amodal_max_px = Vec2::Zero();
  double truncation = 0;  ///< fraction of the amodal box outside the image, in [0, 1]
  Pose X_CO = Pose::Identity();
  Vec3 size_O_m = Vec3::Zero();
  std::vector<Keypoint> keypoints;
  std::optional<ObjectLight> light;  ///< only with the camera's light labels
};

/// Camera settings of one image.
struct PictureExposure {
  double exposure_s = 0, f_number = 0, gain_db = 0;
  double saturation_cdpm2 = 0;  ///< luminance on the axis that saturates green
  Vec3 balance = Vec3::Ones();  ///< gains of red, green and blue
};

/// Load of one shovel at the time of an image, visible or not.
struct CarriedLoad {
  std::uint16_t instance = 0;  ///< instance of the soil in the instance image: its mask
  std::string name;
  std::int64_t visible_px = 0;
  double volume_m3 = 0, mass_kg = 0;
  double fill = 0;                      ///< volume over the shovel's heaped capacity
  std::optional<double> released_kgps;  ///< loss rate since the previous image, if any
};

/// One exposure. All images share one pixel grid; images that the camera does not produce are
/// empty.
struct CameraFrame {
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  Image<std::uint8_t> rgb;        ///< 3 channels, sRGB
  Image<float> depth_m;           ///< planar depth (z in C); 0: no measurement
  Image<std::uint8_t> semantic;   ///< SemanticClass
  Image<std::uint16_t> instance;  ///< 0: none; otherwise instance index in dataset.yaml
  Image<std::uint16_t> normal;    ///< 3 channels: surface_normal.h
  Image<std::uint16_t> distance;  ///< distance to the camera centre, exact: PixelOfDistance
  /// Flow from this image's pixels to the previous image, and from the previous image's pixels to
  /// this image. 3 channels, PixelOfFlow; all 0 in the first image.
  Image<std::uint16_t> flow_to_previous, flow_to_this;
  Image<std::uint16_t> scene_flow_to_previous;  ///< first image: 0; 3 channels, PixelOfShift
  Image<std::uint8_t> ground_soil;              ///< PixelOfSoil
  Image<std::uint8_t> ground_state;  ///< looseness, moisture and rut as in TerrainSurface::Cover
  Image<std::uint16_t> ground_change, ground_age;  ///< PixelOfRise, PixelOfAge
  Image<std::uint16_t> dust_optical_depth;         ///< PixelOfOpticalDepth
  Image<std::uint8_t> lens_soiling;                ///< transmittance of the lens, in 1/255
  Image<std::uint8_t> panoptic;        ///< 3 channels: class, instance mod 256, instance / 256
  Image<std::uint8_t> soil_in_flight;  ///< 255: a clod in the air or rolling down a slope
  std::vector<ObjectBox> boxes;
  std::optional<PictureExposure> exposure;  ///< only with the camera's exposure labels
  std::vector<CarriedLoad> loads;           ///< only with the camera's load labels
};

/// One lidar return, in the sensor frame at the time of its ray.
struct LidarPoint {
  float x_m = 0, y_m = 0, z_m = 0;
  float intensity = 0;               ///< relative reflectivity, in [0, 1]
  std::uint32_t time_offset_ns = 0;  ///< since the scan's t_ns
  std::uint16_t ring = 0;
  std::uint16_t instance = 0;
  std::uint8_t label = 0;  ///< SemanticClass
};

/// One revolution. t_ns is the time of its first ray. Rays without a return produce no point.
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

/// Numeric values of one instant; the channel names the columns. Low-dimensional sensors use this
/// form for their samples (sample_rows.h), as do truth tables.
struct RowSample {
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  std::vector<double> values;
};

/// Content of a channel from a sensor to its consumers.
using Measurement = std::variant<RowSample, CameraFrame, LidarScan>;

}  // namespace tera
