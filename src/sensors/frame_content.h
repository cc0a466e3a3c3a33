#pragma once

#include "core/types/label_channels.h"
#include "render/gl/camera_intrinsics.h"

/// What the pictures or scans of a sensor hold, for whoever announces or reads them.

namespace tera {

/// Of a sensor that takes pictures, all on one pixel grid.
struct PictureContent {
  CameraIntrinsics intrinsics;
  bool rgb = true;
  bool depth = false;
  LabelSet labels = UsualLabels();  ///< with boxes where instance is among them
  double depth_min_m = 0.1, depth_max_m = 20.0;
};

/// Of a sensor that scans: rays of one scan, each of which has a point at most.
struct ScanContent {
  int rings = 0, columns = 0;
};

}  // namespace tera
