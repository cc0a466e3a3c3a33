#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/export/picture/object_masks.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {

/// A labelled object in a picture in KITTI's format, or a region excluded from evaluation.
///
/// Frames  the camera's optical frame C of the rectified picture; pixels from 0.
/// Model   `location` is the middle of the 3-D box's lower face. rotation_y is the angle about C's
///         y from C's x to the object's forward axis, seen along y. alpha is rotation_y minus the
///         bearing atan2(x, z) of `location`. The truncated share is that of the 3-D box's volume
///         outside the camera's view.
/// Omits   tilt of the object against the camera: KITTI's boxes turn about C's y alone.
/// Source  Geiger et al. 2012, "Are we ready for autonomous driving?", and the `readme.txt` of the
///         object and of the tracking development kit.
struct KittiLabel {
  bool is_region = false;  ///< DontCare: only `bounds` is valid
  std::uint16_t instance = 0;
  std::string type;
  double truncated = 0;   ///< share, 0 to 1
  double visibility = 1;  ///< visible share of the part inside the picture
  PixelBounds bounds;
  double height_m = 0, width_m = 0, length_m = 0;
  Vec3 location_C_m = Vec3::Zero();
  double rotation_y_rad = 0, alpha_rad = 0;
};

/// Labels of the top-level objects with pixels among `masks`. Objects of `own_machine`, which
/// carries the camera, are regions.
std::vector<KittiLabel> KittiLabels(const std::vector<ObjectBox>& boxes,
                                    const std::map<std::uint16_t, ObjectMask>& masks,
                                    const CameraLens& lens, const std::string& own_machine);

/// The 15 fields of the object benchmark, with the line's end.
std::string ObjectLine(const KittiLabel& label);
/// The 17 fields of the tracking benchmark, where truncation has three levels.
std::string TrackLine(int frame, const KittiLabel& label);

}  // namespace tera
