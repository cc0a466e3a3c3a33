#pragma once

#include <array>
#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/measures/polar_grid.h"
#include "layout/measures/polar_map.h"

namespace tera {

/// Pixel density of a layout's cameras on a person around the machine.
///
/// Frames  H as in PolarGrid. Distances run from its origin to the centre of a cell.
/// Model   tests the places of PolarGrid 1.5 m above the ground that lie in the air over the site
///         and outside the machine's outline. The density at a place is the maximum over the
///         cameras with a free line of sight. It is the square root of the pixels per square metre
///         of a surface that faces the camera.
/// Omits   the standard's other demands on a picture: focus, light, contrast, compression, motion.
/// Source  IEC 62676-4: 25 px/m detect, 62.5 observe, 125 recognise, 250 identify. NIOSH's highest
///         plane, 1500 mm, represents the upper body of a standing person.
class PixelDensity {
 public:
  struct Purpose {
    const char* name;
    double px_per_m;
  };
  static constexpr std::array<Purpose, 4> kPurposes = {
      {{"detect", 25}, {"observe", 62.5}, {"recognise", 125}, {"identify", 250}}};
  static constexpr double kHeight_m = 1.5;

  PixelDensity();

  /// Adds the places of this moment at kHeight_m. The caller has excluded those inside the
  /// machine's outline (LeaveOutHull).
  void Add(const PolarPlaces& places, const Layout& layout, const Sighting& sighting);

  /// "pixels/PURPOSE/share_to_12m": share of the area within 12 m that has the purpose's density.
  /// "pixels/PURPOSE/mean_to_m_ahead", "_left", "_behind", "_right": farthest distance with that
  /// density in a direction, averaged over the directions of the quarter.
  std::vector<Figure> Figures() const;
  /// "pixels/1.5 m": density at each place, averaged over the moments.
  PolarMap Map() const;
  /// "pixels/PURPOSE": for each direction of PolarGrid, the distance of the farthest place with at
  /// least the purpose's density, even if nearer places have less. 0 without such a place.
  std::vector<PolarCurve> Curves() const;

 private:
  using OfSectors = std::vector<std::vector<double>>;
  std::vector<OfSectors> farthest_m_;       ///< [purpose][sector][moment]
  std::vector<std::vector<double>> share_;  ///< [purpose][moment]
  std::vector<double> near_places_;         ///< LikeCount, one per moment
  std::vector<double> sum_px_per_m_, counted_;
};

}  // namespace tera
