#pragma once

#include <vector>

#include "core/types/measurement.h"
#include "render/scene.h"

namespace tera {

/// Load and release rate of each shovel in the scene.
///
/// Model   True volume and mass. `released_kgps` is the mass lost since the previous image, divided
///         by the time since then. It is negative while the shovel fills.
/// Omits   Simultaneous inflow and outflow: only the difference counts. A fill below 1e-4 of a
///         shovel counts as empty.
class LoadLabels {
 public:
  /// Labels the shovels of `model` at `state`, with pixels from `frame`. Call it once per image, in
  /// order.
  void Fill(const SceneModel& model, const SceneState& state, CameraFrame* frame);

 private:
  /// mass of each shovel at the previous image; empty before the first
  std::vector<double> before_kg_;
  TimeNs before_ns_ = 0;
};

}  // namespace tera
