#pragma once

#include <string>
#include <vector>

#include "core/motion.h"
#include "layout/measures/figure.h"
#include "layout/measures/polar_map.h"
#include "layout/sight/sighting.h"
#include "sensors/sensor.h"

namespace tera {

/// The sky above an antenna in cells of equal width in azimuth and elevation.
///
/// Frames  A stands upright in the antenna, turned to the heading of its link: azimuth 0 is ahead,
///         counterclockwise from above. Ring 0 is about the zenith.
struct SkyGrid {
  static constexpr int kSectors = 72, kRings = 18;
  static constexpr double kRing_deg = 5;

  static std::size_t Index(int sector, int ring) {
    return static_cast<std::size_t>(sector) * kRings + ring;
  }
};

/// How much of the sky each GNSS antenna of a layout does not see, moment by moment.
///
/// Frames  A as in SkyGrid.
/// Model   the sky is the hemisphere above an elevation mask, by solid angle. One ray a cell from
///         the antenna, evenly at random in the cell's solid angle, the same at every moment. A
///         direction is hidden by what the ray meets first: by the antenna's own machine, whatever
///         part of it and with what it carries, or by the site, which is everything else: ground,
///         trucks, trees, other machines. The two are counted apart, since a layout can change the
///         first alone; their sum is all that is hidden.
/// Omits   diffraction and what passes through leaves, glass or plastics; where the satellites are;
///         signals that arrive by reflection.
/// Source  the mask: of those that receivers and programs have at first, between 7 degrees (NavCom,
///         "Sapphire technical reference manual", rev. J, NAVELEVMASK) and 13 (Trimble Business
///         Center's help, "elevation mask").
class SkyView {
 public:
  static constexpr double kMask_deg = 10;

  /// The antennas among `sensors` of machine number `machine`. Directions below `mask_deg` do not
  /// count, of cells that the mask cuts what lies above it.
  SkyView(const MachineModel& model, std::size_t machine,
          const std::vector<SensorDescription>& sensors, double mask_deg = kMask_deg);

  /// Adds the moment that `sighting` shows, with the machine as it is then.
  void Add(const MachineState& machine, const Sighting& sighting);

  /// "sky/ANTENNA/hidden", by the machine, and "sky/ANTENNA/hidden_by_site".
  std::vector<Figure> Figures() const;
  /// "sky/ANTENNA/hidden": share of the moments in which the machine hides each cell, by
  /// SkyGrid::Index; negative below the mask.
  std::vector<PolarMap> Maps() const;

 private:
  /// A direction that is tried, for the part of the sky around it.
  struct Direction {
    std::size_t cell = 0;
    Vec3 d_A = Vec3::UnitZ();
    double share = 0;  ///< of the sky
  };
  struct Antenna {
    std::string name;
    int link = 0;
    Vec3 p_BS_m = Vec3::Zero();
    std::vector<double> by_machine = {}, by_site = {};  ///< of each moment
    std::vector<double> hidden_moments = {};            ///< of each cell
  };

  std::size_t machine_;
  std::vector<Direction> sky_;
  std::vector<Antenna> antennas_;
};

}  // namespace tera
