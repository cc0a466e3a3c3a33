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

/// What a camera says of the objects in its picture beside their boxes.
struct ObjectLabels {
  bool exposure = false;  ///< ObjectLight of each, PictureExposure of all
  bool load = false;      ///< CarriedLoad of each shovel
};

/// What a camera is: its optics, its outputs and their noise.
struct CameraModel : PictureContent {
  double disparity_noise_px = 0;  ///< sigma_d of the depth, 1 sigma; 0 switches it off
  double baseline_m = 0.05;       ///< b, between the two eyes of a depth camera
  double rgb_noise = 0;           ///< 1 sigma of the sRGB value in 0..255, without an image sensor
  std::optional<ImageSensorModel> image_sensor;     ///< none: colour at the scene's exposure
  std::optional<OpticsModel> optics;                ///< before an image sensor; none: ideal
  std::optional<StereoModel> stereo;                ///< depth is matched between two eyes
  std::optional<TimeOfFlightModel> time_of_flight;  ///< or measured by light's own time
  ObjectLabels object_labels;
};

CameraModel ReadCameraModel(const ConfigMap& config);
/// The model as sensor.yaml has it, two blanks before each key.
std::string CameraModelYaml(const CameraModel& model);

/// The value of the key `labels`: true for the usual ones, false for none, else their names.
std::string LabelsYaml(LabelSet labels);

/// Pose of the optical frame C in the sensor frame S: z of C is x of S, x of C is -y of S.
Pose OpticalInSensor();

/// Camera for colour, planar depth and labels on one pixel grid.
///
/// Frames  W world; S sensor, x forward, y left, z up; C optical, x right, y down, z forward, at
///         X_SC = OpticalInSensor(). Pixel (0, 0) has its centre at the image point (0, 0).
/// Model   the whole picture at one instant, that of its time stamp, or with a shutter each row
///         exposed for a while about its own time, the middle row about the stamp's (sweep.h).
///         Depth is z in C, or behind a lens that looks sideways the distance, with the noise of a
///         stereo pair, whose disparity f b / z is off by N(0, sigma_d^2), so that sigma_z =
///         z^2 sigma_d / (f b) where that is small, and 0 outside its limits; colour is sRGB at
///         the scene's exposure plus N(0, sigma^2), clipped, or what an image sensor makes of the
///         scene's luminance (image_sensor.h), whose exposure and balance may follow the pictures
///         before (exposure_control.h). Noise is drawn for each pixel alone. Behind dust of optical
///         depth t the noise of the disparity is exp(t) as large, and there is no depth where less
///         than kLeastContrast (dust_sight.h) is left.
///         Before an image sensor the lens may blur and scatter, and its glass be dirty (optics.h).
///         Depth may instead be that of a stereo matcher (stereo.h) or of time of flight
///         (time_of_flight.h), both of the instant of the stamp.
/// Omits   of the depth with noise the holes and the smoothing of a real stereo matcher.
/// Source  lens: Brown 1971, "Close-range camera calibration"; sigma_z: Khoshelham and Elberink
///         2012, "Accuracy and resolution of Kinect depth data for indoor mapping applications".
class Camera {
 public:
  Camera(const CameraModel& model, const SampleClock& clock, TimeNs latency_ns, std::uint64_t seed,
         const std::string& stream_name);
  /// Exposure k of the scene with the sensor at X_WS, where all stands still.
  CameraFrame Measure(std::int64_t k, const Pose& X_WS, const SceneState& scene,
                      Rasterizer* rasterizer);
  /// Exposure k of a scene that is asked for at times from Reach() before its stamp to Reach()
  /// after it, which may move.
  CameraFrame Measure(std::int64_t k, const SceneAt& scene_at, Rasterizer* rasterizer);
  /// Whether a picture follows from those before, so that none may be left out.
  bool HasMemory() const {
    return surface_labels_.HasMemory() || model_.object_labels.load ||
           (control_ && (control_->meters_exposure() || control_->meters_balance()));
  }
  /// The time from the first light of a picture to its stamp, and from there to the last, at most.
  TimeNs Reach() const;
  const CameraModel& model() const { return model_; }

 private:
  /// Where pictures beside those of the frame go, if they are asked for.
  struct Beside {
    LuminancePicture* luminance;
    Image<std::uint16_t>* body;
    Image<float>* light;
  };
  CameraFrame See(const SceneAt& scene_at, TimeNs t_ns, Rasterizer* rasterizer,
                  const Beside& beside) const;
  /// What is said of objects and of the whole picture, of a frame with its exact depth.
  void Label(const SceneAt& scene_at, const Rasterizer& rasterizer, const Beside& beside,
             CameraFrame* frame);
  /// Optical depth of the dust before what each pixel shows; empty where nothing needs it.
  Image<float> Dust(const SceneAt& scene_at, TimeNs t_ns, const Rasterizer& rasterizer,
                    const Image<float>& depth_m);
  /// What the depth sensor makes of picture k, whose depth is exact, through `dust`.
  Image<float> Range(std::int64_t k, const SceneAt& scene_at, const Image<float>& dust,
                     Image<float> depth_m, Rasterizer* rasterizer) const;
  /// sRGB of picture k, which the control takes note of.
  Image<std::uint8_t> Sense(const Image<float>& luminance_cdpm2, std::int64_t k);

  CameraModel model_;
  SampleClock clock_;
  TimeNs latency_ns_;
  UniformBits depth_noise_, rgb_noise_;
  std::optional<ImageSensor> image_sensor_;
  std::optional<ExposureControl> control_;  ///< of an image sensor
  SurfaceLabels surface_labels_;
  std::optional<Optics> optics_;
  std::optional<Stereo> stereo_;
  std::optional<TimeOfFlight> time_of_flight_;
  std::optional<PixelRays> rays_;  ///< where objects' light is labelled, or dust is in the air
  LoadLabels load_labels_;
};

}  // namespace tera
