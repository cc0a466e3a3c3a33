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

/// Output of a luminance image.
///
/// Model   three channels in cd/m2, linear in the primaries of sRGB. The edge filter measures
///         contrast relative to `white_cdpm2`, so the scene's exposure has no effect.
struct LuminancePicture {
  double white_cdpm2 = 1;
  Image<float> cdpm2;  ///< output
};

/// Renders colour, depth, class and instance of one camera in one pass, without a display.
///
/// Model   deferred shading: one geometry pass writes albedo, normal, label and depth. Light comes
///         from the sun with a shadow map, from the sky with ambient occlusion, and from lamps.
///         Koschmieder fog and a filmic tone curve follow.
///         A distorting lens resamples a finer pinhole image. A backdrop of land surrounds the site
///         and is labelled as terrain.
///         Surface normals are the shading normals, turned towards the camera. Those of meshes
///         include smoothing; those of the ground include the relief of its grain.
/// Omits   depth beyond far_m is 0, but colour and labels extend to the horizon. Glass is blended
///         in colour only: labels, normals and depth are those of the glass.
/// Throws  InputError without an EGL platform that supports OpenGL 4.5 core.
///
/// One thread at a time may use a rasterizer. `threads` share the CPU work of an image; their
/// number does not change the image.
class Rasterizer {
 public:
  Rasterizer(const SceneModel& model, const EglOptions& options, int threads = 1);
  ~Rasterizer();

  const GlInfo& info() const;
  const SceneModel& model() const;
  /// The worker threads, free for work on a finished image while no image is being drawn.
  Workers* workers() const;
  /// Illuminance by the sun on a plane that faces it, in the primaries of sRGB.
  Vec3 sun_illuminance_lx() const;
  /// Terrain tiles sent to the GPU since construction.
  std::int64_t uploaded_tiles() const;
  /// Triangles since construction, including those of shadows and of unoccluded pixel counts.
  std::int64_t triangles_drawn() const;

  /// Calls `done` with the name of each pass when the GPU has completed it, for profiling. The
  /// waiting slows rendering. An empty function disables the calls.
  using PassWatch = std::function<void(const char* pass)>;
  void Watch(PassWatch done);

  /// Renders the view of a camera at X_WC at state.t_ns. Fills rgb, depth_m, boxes, the usual
  /// labels, and those further channels in `labels` that shaders write. With `luminance`, the
  /// luminance image replaces rgb. `body` receives the body image (body_picture.h). `light`
  /// receives two channels: illuminance of each pixel's surface in lx, and the fraction of the sun
  /// that reaches it.
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
