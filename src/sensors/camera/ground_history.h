#pragma once

#include <optional>
#include <vector>

#include "core/time.h"
#include "core/types/terrain_surface.h"

namespace tera {

/// Change of the ground since a camera's first image.
///
/// Frames  W.
/// Model   the nearest vertex supplies the cover; the height change applies to the surface at the
///         point. A vertex is touched if its height or cover is set between images; weather touches
///         nothing.
class GroundHistory {
 public:
  struct State {
    TerrainSurface::Cover cover;
    double risen_m = 0;                  ///< since the first image
    std::optional<TimeNs> untouched_ns;  ///< since the last touch; nullopt: never touched
  };

  /// Records the ground at the time of an image; a single call per image, in order.
  void Advance(const TerrainSurface& ground, TimeNs t_ns);
  /// State at the last image; nullopt outside the site.
  std::optional<State> At(double x_m, double y_m) const;

 private:
  void NoteTile(const TerrainSurface& ground, int a, int b);

  TimeNs t_ns_ = 0;
  std::optional<TerrainSurface> first_, now_;
  /// Last touch time of each touched vertex of a tile, row-major over its squares and its upper
  /// border.
  std::vector<std::vector<std::optional<TimeNs>>> touched_ns_;
};

}  // namespace tera
