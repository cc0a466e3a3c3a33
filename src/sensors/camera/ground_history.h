#pragma once

#include <optional>
#include <vector>

#include "core/time.h"
#include "core/types/terrain_surface.h"

namespace tera {

/// What has become of the ground since a camera's first picture.
///
/// Frames  W.
/// Model   cover is that of the nearest vertex; the change of height is that of the surface at the
///         point. A vertex is touched when its height or its cover changes from one picture to the
///         next.
class GroundHistory {
 public:
  struct State {
    TerrainSurface::Cover cover;
    double risen_m = 0;                  ///< since the first picture
    std::optional<TimeNs> untouched_ns;  ///< since the last touch; never: nothing
  };

  /// Takes note of the ground at the time of a picture; once for each, in order.
  void Advance(const TerrainSurface& ground, TimeNs t_ns);
  /// At the time of the last picture; nothing beyond the site.
  std::optional<State> At(double x_m, double y_m) const;

 private:
  void NoteTile(const TerrainSurface& ground, int a, int b);

  TimeNs t_ns_ = 0;
  std::optional<TerrainSurface> first_, now_;
  /// When each vertex of a tile was touched, of those that were: row-major over its squares and its
  /// upper border.
  std::vector<std::vector<std::optional<TimeNs>>> touched_ns_;
};

}  // namespace tera
