#pragma once

#include <vector>

#include "core/types/measurement.h"
#include "render/scene.h"

namespace tera {

/// Load and release rate of each shovel in the scene at an image.
///
/// Model   true volume and mass. `released_kgps` is the mass lost since the previous image over the
///         time between; it is negative while the shovel fills.
/// Omits   simultaneous inflow and outflow: only the difference counts. A fill below 1e-4 of a
///         shovel counts as empty.
class LoadLabels {
 public:
  /// Labels the shovels of `model` at `state`, with pixels from `frame`; a single call per image,
  /// in order.
  void Fill(const SceneModel& model, const SceneState& state, CameraFrame* frame);

 private:
  std::vector<double> before_kg_;  ///< mass per shovel at the previous image; empty: none
  TimeNs before_ns_ = 0;
};

}  // namespace tera
