#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/types/measurement.h"
#include "render/scene.h"

namespace tera {

/// Pinhole intrinsics with Brown-Conrady distortion, as in OpenCV and ROS CameraInfo.
///
/// Frames  C optical frame (x right, y down, z forward). Pixel (0, 0) is the centre of the upper
///         left pixel.
/// Model   x = X/Z, y = Y/Z, r2 = x2 + y2;
///         x' = x (1 + k1 r2 + k2 r4 + k3 r6) + 2 p1 x y + p2 (r2 + 2 x2), y' likewise;
///         u = fx x' + cx, v = fy y' + cy.
/// Source  Brown 1971; OpenCV 4.6 calib3d documentation.
struct CameraIntrinsics {
  int width_px = 640, height_px = 480;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  double near_m = 0.05, far_m = 300.0;

  bool Distorted() const { return k1 != 0 || k2 != 0 || p1 != 0 || p2 != 0 || k3 != 0; }
  /// Pixel of a point in C, Z > 0.
  Vec2 Project(const Vec3& p_C_m) const;
  /// Direction (x, y, 1) in C of a pixel, by Newton's method on the distortion.
  Vec3 Unproject(const Vec2& pixel_px) const;
  /// As Unproject, but nothing where the distortion folds the picture over or turns the ray beyond
  /// kWidestTangent from the axis.
  std::optional<Vec3> RayOf(const Vec2& pixel_px) const;
  /// A pixel on the border, or of a grid over the picture, for which RayOf has nothing.
  std::optional<Vec2> PixelWithoutRay() const;

  static constexpr double kWidestTangent = 4.0;
};

struct EglOptions {
  int device =
      -1;  ///< index of an EGL device with a GPU; -1 chooses (GPU if there is one, else Mesa)
};

/// What OpenGL we got.
struct GlInfo {
  std::string egl_platform;  ///< "device 0" or "surfaceless"
  std::string vendor, renderer, version;
};

/// Renders colour, planar depth, class and instance of one camera in one pass, without a display.
///
/// Model   deferred shading: one pass over the geometry gives albedo, normal, label and depth; sun
///         with shadow map, sky light with occlusion, Koschmieder fog, filmic tone curve. A lens
///         that distorts is a finer pinhole picture, resampled. Around the site lies a backdrop of
///         land, labelled terrain.
/// Omits   depth beyond far_m is 0, while colour and labels go on to the horizon. Glass is blended
///         in colour; label and depth are those of the glass.
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

  /// What a camera at X_WC sees. Fills rgb, depth_m, semantic, instance and boxes of the frame;
  /// t_ns is state.t_ns.
  CameraFrame Render(const CameraIntrinsics& camera, const Pose& X_WC, const SceneState& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera
