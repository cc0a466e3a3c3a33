#pragma once

#include <array>
#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/measures/polar_grid.h"
#include "layout/measures/polar_map.h"

namespace tera {

/// How finely the cameras of a layout show a person who stands around the machine.
///
/// Frames  H as in PolarGrid. Distances are from its origin, to the middle of a cell.
/// Model   places of PolarGrid 1.5 m above the ground, those that lie in the air over the site and
///         outside the outline of the machine. The density at a place is that of the camera that
///         shows it most finely with nothing in the way: the square root of its pixels per square
///         metre of a surface that faces it.
/// Omits   what else the standard asks of a picture: focus, light, contrast, compression, motion.
/// Source  IEC 62676-4: 25 px/m detect, 62.5 observe, 125 recognise, 250 identify. NIOSH's highest
///         plane, 1500 mm, for the upper body of a person who stands.
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

  /// Adds what `layout` shows of the places of this moment at kHeight_m, in the outline of no
  /// machine (LeaveOutHull).
  void Add(const PolarPlaces& places, const Layout& layout, const Sighting& sighting);

  /// "pixels/PURPOSE/share_to_12m": of the area of places within 12 m;
  /// "pixels/PURPOSE/mean_to_m_ahead", "_left", "_behind", "_right": the mean over the directions
  /// of that quarter.
  std::vector<Figure> Figures() const;
  /// "pixels/1.5 m": the density, as a mean over the moments.
  PolarMap Map() const;
  /// "pixels/PURPOSE": of each purpose the farthest place, by direction of PolarGrid, at which the
  /// density is at least the purpose's, whether it is nearer or not; 0 where it is nowhere.
  std::vector<PolarCurve> Curves() const;

 private:
  using OfSectors = std::vector<std::vector<double>>;
  std::vector<OfSectors> farthest_m_;       ///< [purpose][sector][moment]
  std::vector<std::vector<double>> share_;  ///< [purpose][moment]
  std::vector<double> near_places_;         ///< LikeCount of each moment
  std::vector<double> sum_px_per_m_, counted_;
};

}  // namespace tera
