#pragma once

#include <vector>

#include "core/types/measurement.h"
#include "render/scene.h"

namespace tera {

/// What each shovel in the scene carries at a picture, and what it lets go.
///
/// Model   volume and mass of the truth; `released_kgps` is the mass that it has lost since the
///         picture before over the time between, negative while it fills.
/// Omits   soil that comes in while other soil goes: the difference counts. What fills less than
///         1e-4 of a shovel counts as nothing.
class LoadLabels {
 public:
  /// The shovels of `model` at `state`, whose pixels are those of `frame`; once for each picture,
  /// in order.
  void Fill(const SceneModel& model, const SceneState& state, CameraFrame* frame);

 private:
  std::vector<double> before_kg_;  ///< of each shovel at the picture before; empty: there is none
  TimeNs before_ns_ = 0;
};

}  // namespace tera
