#pragma once

#include "core/types/label_channels.h"
#include "render/gl/camera_intrinsics.h"

/// Content of a sensor's images or scans, for writers and readers.

namespace tera {

/// Content of an imaging sensor; all images share one pixel grid.
struct PictureContent {
  CameraIntrinsics intrinsics;
  bool rgb = true;
  bool depth = false;
  LabelSet labels = UsualLabels();  ///< with boxes if it includes instance
  double depth_min_m = 0.1, depth_max_m = 20.0;
};

/// Content of a scanning sensor: rays per scan, each with at most `returns` points.
struct ScanContent {
  int rings = 0, columns = 0;
  int returns = 1;
};

}  // namespace tera
