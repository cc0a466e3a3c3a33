#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/export/picture/object_masks.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {

/// A label of KITTI: an object, or a region that evaluation ignores.
///
/// Frames  C optical frame of the rectified image; pixels counted from 0.
/// Model   `location` is the centre of the 3D box's lower face. rotation_y is the rotation about
///         C's y axis from C's x axis to the object's forward axis. alpha is rotation_y minus the
///         bearing atan2(x, z) of `location`. `truncated` is the fraction of the 3D box's volume
///         outside the view of the camera.
/// Omits   tilt of the object relative to the camera: KITTI's boxes rotate about C's y axis only.
/// Source  Geiger et al. 2012, "Are we ready for autonomous driving?", and the `readme.txt` of the
///         object and of the tracking development kit.
struct KittiLabel {
  bool is_region = false;  ///< type DontCare; only `bounds` is valid
  std::uint16_t instance = 0;
  std::string type;
  double truncated = 0;   ///< fraction in [0, 1]
  double visibility = 1;  ///< visible fraction of the part inside the image
  PixelBounds bounds;
  double height_m = 0, width_m = 0, length_m = 0;
  Vec3 location_C_m = Vec3::Zero();
  double rotation_y_rad = 0, alpha_rad = 0;
};

/// Labels of all objects that have pixels in `masks` and are not parts of other objects. Objects of
/// `own_machine`, the machine that carries the camera, become regions.
std::vector<KittiLabel> KittiLabels(const std::vector<ObjectBox>& boxes,
                                    const std::map<std::uint16_t, ObjectMask>& masks,
                                    const CameraLens& lens, const std::string& own_machine);

/// Line of the object benchmark: 15 fields and the line end.
std::string ObjectLine(const KittiLabel& label);
/// Line of the tracking benchmark: 17 fields and the line end. Its truncation has three levels.
std::string TrackLine(int frame, const KittiLabel& label);

}  // namespace tera
