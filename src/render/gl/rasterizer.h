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

/// A picture in luminance.
///
/// Model   three channels, linear in the primaries of sRGB. Edges are smoothed by the contrast that
///         they have where `white_cdpm2` is the brightest, whatever the scene's own exposure.
struct LuminancePicture {
  double white_cdpm2 = 1;
  Image<float> cdpm2;  ///< filled
};

/// Renders colour, planar depth, class and instance of one camera in one pass, without a display.
///
/// Model   deferred shading: one pass over the geometry gives albedo, normal, label and depth; sun
///         with shadow map, sky light with occlusion, Koschmieder fog, filmic tone curve. A lens
///         that distorts is a finer pinhole picture, resampled. Around the site lies a backdrop of
///         land, labelled terrain.
///         Surface normals are those that colour is shaded with, towards the eye: a mesh's own,
///         smooth where it is shaded so, and on the ground with the relief of its grain.
/// Omits   depth beyond far_m is 0, while colour and labels go on to the horizon. Glass is blended
///         in colour; labels, normals and depth are those of the glass.
/// Throws InputError if no EGL platform with OpenGL 4.5 core can be had. May be used from any
/// thread, one at a time; what the processor does for a picture is shared by `threads`, whose
/// number changes no pixel.
class Rasterizer {
 public:
  Rasterizer(const SceneModel& model, const EglOptions& options, int threads = 1);
  ~Rasterizer();

  const GlInfo& info() const;
  const SceneModel& model() const;
  /// The threads, for what is made of a picture while none is drawn.
  Workers* workers() const;
  /// Of the sun on a plane that faces it, in the primaries of sRGB.
  Vec3 sun_illuminance_lx() const;
  /// Terrain tiles sent to the GPU since construction.
  std::int64_t uploaded_tiles() const;
  /// Triangles sent to the GPU since construction, those of shadows and of boxes' silhouettes too.
  std::int64_t triangles_drawn() const;

  /// From now on `done` is told each pass of a picture when all of it has been drawn, for
  /// measurements: waiting for that takes time of its own. Nothing: nobody is told.
  using PassWatch = std::function<void(const char* pass)>;
  void Watch(PassWatch done);

  /// What a camera at X_WC sees. Fills rgb, depth_m, boxes and the usual labels of the frame, and
  /// what `labels` names beside them of what shaders write; t_ns is state.t_ns. With `luminance` it
  /// is that which is filled in the place of rgb; `body`, if asked for, becomes the picture of
  /// bodies (body_picture.h), and `light` of two channels: the illuminance of what each pixel
  /// shows, in lx, and the share of the sun that reaches it.
  CameraFrame Render(const CameraIntrinsics& camera, const Pose& X_WC, const SceneState& state,
                     LabelSet labels = {}, LuminancePicture* luminance = nullptr,
                     Image<std::uint16_t>* body = nullptr, Image<float>* light = nullptr);
  /// That luminance alone.
  void RenderLuminance(const CameraIntrinsics& camera, const Pose& X_WC, const SceneState& state,
                       LuminancePicture* luminance);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera
