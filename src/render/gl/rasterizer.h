#pragma once

#include <cstdint>
#include <memory>

#include "core/types/label_channels.h"
#include "core/types/measurement.h"
#include "render/gl/camera_intrinsics.h"
#include "render/gl/egl_options.h"
#include "render/scene.h"

namespace tera {

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
/// thread, one at a time.
class Rasterizer {
 public:
  Rasterizer(const SceneModel& model, const EglOptions& options);
  ~Rasterizer();

  const GlInfo& info() const;
  /// Terrain tiles sent to the GPU since construction.
  std::int64_t uploaded_tiles() const;
  /// Triangles sent to the GPU since construction, those of shadows and of boxes' silhouettes too.
  std::int64_t triangles_drawn() const;

  /// What a camera at X_WC sees. Fills rgb, depth_m, boxes and the usual labels of the frame, and
  /// what `labels` names beside them; t_ns is state.t_ns. With `luminance_cdpm2` it is that which
  /// is filled in the place of rgb: three channels in cd/m^2, linear in the primaries of sRGB.
  CameraFrame Render(const CameraIntrinsics& camera, const Pose& X_WC, const SceneState& state,
                     LabelSet labels = {}, Image<float>* luminance_cdpm2 = nullptr);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera
