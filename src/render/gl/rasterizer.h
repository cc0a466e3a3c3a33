#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "core/types/label_channels.h"
#include "core/types/measurement.h"
#include "core/workers.h"
#include "render/gl/camera_intrinsics.h"
#include "render/gl/egl_options.h"
#include "render/scene.h"

namespace tera {

/// A luminance image.
///
/// Model   three channels, linear in the primaries of sRGB. The edge filter uses the contrast
///         relative to `white_cdpm2`, independent of the scene's exposure.
struct LuminancePicture {
  double white_cdpm2 = 1;
  Image<float> cdpm2;  ///< output
};

/// Renders colour, planar depth, class and instance of one camera in one pass, without a display.
///
/// Model   deferred shading: one geometry pass produces albedo, normal, label and depth. Lighting
///         consists of sun with shadow map, sky light with occlusion, Koschmieder fog and a filmic
///         tone curve. A distorting lens resamples a finer pinhole image. A backdrop of land,
///         labelled terrain, surrounds the site. Surface normals are the shading normals, oriented
///         towards the eye: mesh normals with their smoothing, and ground normals with the relief
///         of the grain.
/// Omits   depth beyond far_m, which is 0; colour and labels extend to the horizon. Glass is
///         blended in colour, while labels, normals and depth show the glass.
/// Throws  InputError without an EGL platform that supports OpenGL 4.5 core.
///
/// Any thread may use a rasterizer, but only a single thread at a time. `threads` share the CPU
/// work of an image; their number changes no pixel.
class Rasterizer {
 public:
  Rasterizer(const SceneModel& model, const EglOptions& options, int threads = 1);
  ~Rasterizer();

  const GlInfo& info() const;
  const SceneModel& model() const;
  /// Threads for work on a finished image while no image is being drawn.
  Workers* workers() const;
  /// Illuminance of the sun on a plane that faces it, in the primaries of sRGB.
  Vec3 sun_illuminance_lx() const;
  /// Terrain tiles sent to the GPU since construction.
  std::int64_t uploaded_tiles() const;
  /// Number of triangles since construction, including shadows and silhouettes of boxes.
  std::int64_t triangles_drawn() const;

  /// Calls `done` with the name of each pass when the GPU has completed it, for measurements.
  /// Waiting for completion takes extra time. An empty function disables the calls.
  using PassWatch = std::function<void(const char* pass)>;
  void Watch(PassWatch done);

  /// Renders the view of a camera at X_WC at state.t_ns. Fills rgb, depth_m, boxes, the usual
  /// labels and those shader-written channels that `labels` names. `luminance` replaces rgb as
  /// output. `body` receives the body image (body_picture.h). `light` has two channels: illuminance
  /// of each pixel's surface in lx, and the fraction of the sun that reaches it.
  CameraFrame Render(const CameraIntrinsics& camera, const Pose& X_WC, const SceneState& state,
                     LabelSet labels = {}, LuminancePicture* luminance = nullptr,
                     Image<std::uint16_t>* body = nullptr, Image<float>* light = nullptr);
  /// Renders only the luminance.
  void RenderLuminance(const CameraIntrinsics& camera, const Pose& X_WC, const SceneState& state,
                       LuminancePicture* luminance);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera
