#pragma once

#include <optional>
#include <vector>

#include "core/time.h"
#include "core/types/terrain_surface.h"

namespace tera {

/// Change of the ground since the first image of a camera.
///
/// Frames  W.
/// Model   The cover is that of the nearest vertex; the change of height is that of the surface at
///         the point. A vertex is touched if its height or cover is set between images. Weather
///         does not touch it.
class GroundHistory {
 public:
  struct State {
    TerrainSurface::Cover cover;
    double risen_m = 0;                  ///< since the first image
    std::optional<TimeNs> untouched_ns;  ///< time since the last touch; empty if never touched
  };

  /// Records the ground at the time of an image. Call it once per image, in order.
  void Advance(const TerrainSurface& ground, TimeNs t_ns);
  /// State at the last image; empty outside the site.
  std::optional<State> At(double x_m, double y_m) const;

 private:
  void NoteTile(const TerrainSurface& ground, int a, int b);

  TimeNs t_ns_ = 0;
  std::optional<TerrainSurface> first_, now_;
  /// Time of the last touch of each vertex of a tile, row-major, with the upper border. Empty for
  /// an untouched tile.
  std::vector<std::vector<std::optional<TimeNs>>> touched_ns_;
};

}  // namespace tera
