#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/config/config.h"
#include "core/types/measurement.h"
#include "core/uniform_bits.h"
#include "render/gl/rasterizer.h"
#include "sensors/camera/image_sensor.h"
#include "sensors/camera/load_labels.h"
#include "sensors/camera/optics/optics.h"
#include "sensors/camera/pixel_rays.h"
#include "sensors/camera/ranging/stereo.h"
#include "sensors/camera/ranging/time_of_flight.h"
#include "sensors/camera/surface_labels.h"
#include "sensors/camera/sweep.h"
#include "sensors/frame_content.h"

namespace tera {

/// Object labels in addition to boxes.
struct ObjectLabels {
  bool exposure = false;  ///< ObjectLight of each object, PictureExposure of the image
  bool load = false;      ///< CarriedLoad of each shovel
};

struct CameraModel : PictureContent {
  double disparity_noise_px = 0;  ///< sigma_d of the depth, 1 sigma; 0: no noise
  double baseline_m = 0.05;       ///< b, between the two eyes of a depth camera
  double rgb_noise = 0;           ///< 1 sigma of the sRGB value in 0..255, without an image sensor
  std::optional<ImageSensorModel> image_sensor;     ///< none: colour at the scene's exposure
  std::optional<OpticsModel> optics;                ///< none: ideal lens; requires an image sensor
  std::optional<StereoModel> stereo;                ///< depth by stereo matching
  std::optional<TimeOfFlightModel> time_of_flight;  ///< depth by time of flight
  ObjectLabels object_labels;
};

CameraModel ReadCameraModel(const ConfigMap& config);
/// The model as in sensor.yaml, indented by two blanks.
std::string CameraModelYaml(const CameraModel& model);

/// Value of the key `labels`: true for the usual labels, false for none, otherwise a list of names.
std::string LabelsYaml(LabelSet labels);

/// Pose of the optical frame C in the sensor frame S: z of C is x of S, x of C is -y of S.
Pose OpticalInSensor();

/// Camera for colour, depth and labels on one pixel grid.
///
/// Frames  W world; S sensor, x forward, y left, z up; C optical, x right, y down, z forward, at
///         X_SC = OpticalInSensor(). Pixel (0, 0) has its centre at the image point (0, 0).
/// Model   Time: without a shutter, the whole image shows the instant of its time stamp. With a
///         shutter, each row has its own exposure, and that of the middle row is centred at the
///         stamp (sweep.h).
///         Depth: z in C, or the distance for an angular lens; 0 outside its limits. Its noise is
///         that of a stereo pair: the disparity f b / z has the error N(0, sigma_d^2). For small
///         errors, sigma_z = z^2 sigma_d / (f b). Dust of optical depth t multiplies the disparity
///         noise by exp(t). Depth is absent where the contrast falls below kLeastContrast
///         (dust_sight.h). Instead of this model, depth may come from a stereo matcher (stereo.h)
///         or from time of flight (time_of_flight.h), both at the instant of the stamp.
///         Colour: sRGB at the scene's exposure plus N(0, sigma^2), clipped. An image sensor
///         instead converts the luminance of the scene (image_sensor.h). Its exposure and balance
///         may depend on earlier images (exposure_control.h). With an image sensor, the lens may
///         blur and scatter, and its glass may be dirty (optics.h). Noise is independent between
///         pixels.
/// Omits   Holes and smoothing of a real stereo matcher, for depth with noise.
/// Source  Lens: Brown 1971, "Close-range camera calibration"; sigma_z: Khoshelham and Elberink
///         2012, "Accuracy and resolution of Kinect depth data for indoor mapping applications".
class Camera {
 public:
  Camera(const CameraModel& model, const SampleClock& clock, TimeNs latency_ns, std::uint64_t seed,
         const std::string& stream_name);
  /// Exposure k of a static scene with the sensor at X_WS.
  CameraFrame Measure(std::int64_t k, const Pose& X_WS, const SceneState& scene,
                      Rasterizer* rasterizer);
  /// Exposure k of a moving scene. `scene_at` must be valid within Reach() of the stamp.
  CameraFrame Measure(std::int64_t k, const SceneAt& scene_at, Rasterizer* rasterizer);
  /// True if an image depends on earlier images, so that none may be skipped.
  bool HasMemory() const {
    return surface_labels_.HasMemory() || model_.object_labels.load ||
           (control_ && (control_->meters_exposure() || control_->meters_balance()));
  }
  /// Greatest time between the stamp and the first or last light of an image.
  TimeNs Reach() const;
  const CameraModel& model() const { return model_; }

 private:
  /// Optional images in addition to the frame; null if not needed.
  struct Beside {
    LuminancePicture* luminance;
    Image<std::uint16_t>* body;
    Image<float>* light;
  };
  CameraFrame See(const SceneAt& scene_at, TimeNs t_ns, Rasterizer* rasterizer,
                  const Beside& beside) const;
  /// Adds object and image labels to a frame with exact depth.
  void Label(const SceneAt& scene_at, const Rasterizer& rasterizer, const Beside& beside,
             CameraFrame* frame);
  /// Optical depth of dust in front of each pixel's surface; empty if not needed.
  Image<float> Dust(const SceneAt& scene_at, TimeNs t_ns, const Rasterizer& rasterizer,
                    const Image<float>& depth_m);
  /// Optical depth of the air, dust included, in front of each pixel's surface; empty in clear air.
  Image<float> Air(const Rasterizer& rasterizer, Image<float> dust, const Image<float>& depth_m);
  /// Depth image k as the sensor measures it, from the exact `depth_m`. `air` is the result of Air.
  Image<float> Range(std::int64_t k, const SceneAt& scene_at, const Image<float>& air,
                     Image<float> depth_m, Rasterizer* rasterizer) const;
  /// Converts image k to sRGB and passes it to the exposure control.
  Image<std::uint8_t> Sense(const Image<float>& luminance_cdpm2, std::int64_t k);

  CameraModel model_;
  SampleClock clock_;
  TimeNs latency_ns_;
  UniformBits depth_noise_, rgb_noise_;
  std::optional<ImageSensor> image_sensor_;
  std::optional<ExposureControl> control_;  ///< only with an image sensor
  SurfaceLabels surface_labels_;
  std::optional<Optics> optics_;
  std::optional<Stereo> stereo_;
  std::optional<TimeOfFlight> time_of_flight_;
  std::optional<PixelRays> rays_;  ///< for object light labels and airborne dust
  LoadLabels load_labels_;
};

}  // namespace tera
