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

/// What sensors produce and recordings hold: plain data, no behaviour. `t_ns` is the time at which
/// a measurement was valid; `t_available_ns` the time at which a reader could have had it.

namespace tera {

/// Angular rate and specific force of the sensor, expressed in its own frame S (x forward, y left,
/// z up): a sensor at rest and level reads +g on z.
struct ImuSample {
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  Vec3 w_WS_S_radps = Vec3::Zero();
  Vec3 f_S_mps2 = Vec3::Zero();
};

/// Quality of a fix as in the GGA sentence of NMEA 0183.
enum class GnssFix : std::uint8_t {
  kNone = 0,
  kSingle = 1,
  kDifferential = 2,
  kRtkFixed = 4,
  kRtkFloat = 5
};

/// Position of the antenna. Latitude and longitude on WGS 84, height above the ellipsoid; ENU about
/// the site origin, axes of the tangent plane there. With fix kNone all of it is 0 and means
/// nothing.
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

/// What an encoder reads: an angle, or the travel of a prismatic joint.
struct EncoderAxis {
  std::string name;
  bool linear = false;

  bool operator==(const EncoderAxis&) const = default;
};

/// Joint angles (or, for prismatic joints, metres) and rates, in the order of the sensor's joints.
struct EncoderSample {
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  std::vector<double> q_rad;
  std::vector<double> qd_radps;
};

/// A row-major image of `channels` interleaved samples.
template <typename T>
struct Image {
  using Pixel = T;  ///< of one channel

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

/// Whether a camera sees a key point.
enum class KeypointSight : std::uint8_t { kOutside = 0, kHidden = 1, kSeen = 2 };

/// A named point of an object in one image.
struct Keypoint {
  std::string name;
  Vec3 p_C_m = Vec3::Zero();     ///< in the camera optical frame
  std::optional<Vec2> pixel_px;  ///< also beyond the picture; none behind the camera
  KeypointSight sight = KeypointSight::kOutside;
};

/// How much light of an object came into one image, and how far it was smeared there: means over
/// its visible pixels.
struct ObjectLight {
  double blur_px = 0;          ///< way of its points on the picture while the shutter was open
  double most_blur_px = 0;     ///< the longest of these ways
  double luminance_cdpm2 = 0;  ///< towards the camera, before its lens
  double illuminance_lx = 0;   ///< on its surface, from sun, sky and lamps
  double shadow = 0;           ///< share that the sun does not reach; 1 without a sun
};

/// A labelled object in one image.
///
/// Frames  `X_CO` pose of the object's box frame O (centre of its box) in the camera optical frame
///         C (x right, y down, z forward); `size_O_m` the box's edge lengths along O's axes.
struct ObjectBox {
  std::uint16_t instance = 0;
  std::uint16_t parent = 0;  ///< instance of the whole that this is a part of; 0: of none
  SemanticClass label = SemanticClass::kSky;
  std::string name;
  int x_min_px = 0, y_min_px = 0;  ///< visible pixels, inclusive
  int x_max_px = -1, y_max_px = -1;
  std::int64_t visible_px = 0;
  /// Visible pixels over the pixels that the object alone would cover in this image, in [0, 1].
  double visibility = 0;
  /// What the object would cover alone, on a picture without end; pixel centres are whole numbers.
  Vec2 amodal_min_px = Vec2::Zero(), amodal_max_px = Vec2::Zero();
  double truncation = 0;  ///< share of that box beyond the picture, in [0, 1]
  Pose X_CO = Pose::Identity();
  Vec3 size_O_m = Vec3::Zero();
  std::vector<Keypoint> keypoints;
  std::optional<ObjectLight> light;  ///< of a camera that labels it
};

/// What a camera had set for one image.
struct PictureExposure {
  double exposure_s = 0, f_number = 0, gain_db = 0;
  double saturation_cdpm2 = 0;  ///< luminance on the axis that fills the range of green
  Vec3 balance = Vec3::Ones();  ///< factors on red, green and blue
};

/// What one shovel carries at the time of an image, seen or not.
struct CarriedLoad {
  std::uint16_t instance = 0;  ///< of the soil, as in the instance picture: its mask
  std::string name;
  std::int64_t visible_px = 0;
  double volume_m3 = 0, mass_kg = 0;
  double fill = 0;                      ///< volume over the shovel's heaped capacity
  std::optional<double> released_kgps;  ///< what it lost a second since the image before; none: the
                                        ///< first
};

/// One exposure. Images that the camera does not produce are empty. All share one pixel grid.
struct CameraFrame {
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  Image<std::uint8_t> rgb;        ///< 3 channels, sRGB
  Image<float> depth_m;           ///< planar depth (z in C); 0 where there is no measurement
  Image<std::uint8_t> semantic;   ///< SemanticClass
  Image<std::uint16_t> instance;  ///< 0: none; else index of the instance in dataset.yaml
  Image<std::uint16_t> normal;    ///< 3 channels: surface_normal.h
  Image<std::uint16_t> distance;  ///< of the eye, exact: PixelOfDistance
  /// From this picture's pixels to the one before, and from that one's pixels to this: 3 channels,
  /// PixelOfFlow, all 0 of the first picture.
  Image<std::uint16_t> flow_to_previous, flow_to_this;
  Image<std::uint16_t> scene_flow_to_previous;  ///< likewise; 3 channels, PixelOfShift
  Image<std::uint8_t> ground_soil;              ///< PixelOfSoil
  Image<std::uint8_t> ground_state;  ///< looseness, moisture and rut as in TerrainSurface::Cover
  Image<std::uint16_t> ground_change, ground_age;  ///< PixelOfRise, PixelOfAge
  Image<std::uint16_t> dust_optical_depth;         ///< PixelOfOpticalDepth
  Image<std::uint8_t> lens_soiling;                ///< share of light that comes through, of 255
  Image<std::uint8_t> panoptic;        ///< 3 channels: class, instance mod 256, instance / 256
  Image<std::uint8_t> soil_in_flight;  ///< 255: a clod in the air or on its way down a slope
  std::vector<ObjectBox> boxes;
  std::optional<PictureExposure> exposure;  ///< of a camera that labels it
  std::vector<CarriedLoad> loads;           ///< of a camera that labels them
};

/// One lidar return, in the sensor frame at the time of its own ray.
struct LidarPoint {
  float x_m = 0, y_m = 0, z_m = 0;
  float intensity = 0;               ///< reflectivity-like, in [0, 1]
  std::uint32_t time_offset_ns = 0;  ///< since the scan's t_ns
  std::uint16_t ring = 0;
  std::uint16_t instance = 0;
  std::uint8_t label = 0;  ///< SemanticClass
};

/// One revolution; t_ns is the time of its first ray. Rays without a return leave no point.
struct LidarScan {
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  std::vector<LidarPoint> points;
};

/// Pose (and velocity) truth of a machine's root link.
struct TruthPose {
  TimeNs t_ns = 0;
  Pose X_WB = Pose::Identity();
  Vec3 v_WB_mps = Vec3::Zero();
  Vec3 w_WB_B_radps = Vec3::Zero();
};

/// Numbers of one instant. The channel that they belong to names them, one column each. A sensor
/// that measures a few numbers at a time gives its samples in this form (sample_rows.h); so do
/// tables of the truth.
struct RowSample {
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  std::vector<double> values;
};

/// What a channel carries from a sensor to whoever listens.
using Measurement = std::variant<RowSample, CameraFrame, LidarScan>;

}  // namespace tera
