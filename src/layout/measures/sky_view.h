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
/// Frames  A stands upright in the antenna, at the heading of its link: azimuth 0 is ahead,
///         counterclockwise from above. Ring 0 is at the zenith.
struct SkyGrid {
  static constexpr int kSectors = 72, kRings = 18;
  static constexpr double kRing_deg = 5;

  static std::size_t Index(int sector, int ring) {
    return static_cast<std::size_t>(sector) * kRings + ring;
  }
};

/// Share of the sky that is hidden from each GNSS antenna of a layout, moment by moment.
///
/// Frames  A as in SkyGrid.
/// Model   the sky is the hemisphere above an elevation mask, by solid angle. Each cell has one ray
///         from the antenna, drawn uniformly in the cell's solid angle, the same at every moment.
///         The first surface on the ray hides the direction. It belongs to the antenna's own
///         machine with its load, or to the site: ground, trucks, trees, other machines. The two
///         are counted apart, since a layout can change only the first; the total is their sum.
/// Omits   diffraction, and transmission through leaves, glass or plastics; the satellites'
///         positions; reflected signals.
/// Source  the mask lies between common defaults: 7 degrees (NavCom, "Sapphire technical reference
///         manual", rev. J, NAVELEVMASK) and 13 (Trimble Business Center's help, "elevation mask").
class SkyView {
 public:
  static constexpr double kMask_deg = 10;

  /// The antennas among `sensors` on machine number `machine`. Directions below `mask_deg` do not
  /// count. A cell that the mask cuts counts with its upper part.
  SkyView(const MachineModel& model, std::size_t machine,
          const std::vector<SensorDescription>& sensors, double mask_deg = kMask_deg);

  /// Adds the moment of `sighting`. `machine` is the machine's state at that moment.
  void Add(const MachineState& machine, const Sighting& sighting);

  /// "sky/ANTENNA/hidden", by the machine, and "sky/ANTENNA/hidden_by_site".
  std::vector<Figure> Figures() const;
  /// "sky/ANTENNA/hidden": share of the moments at which the machine hides each cell, by
  /// SkyGrid::Index; negative below the mask.
  std::vector<PolarMap> Maps() const;

 private:
  /// A tested direction, which represents the part of the sky around it.
  struct Direction {
    std::size_t cell = 0;
    Vec3 d_A = Vec3::UnitZ();
    double share = 0;  ///< share of the sky's solid angle
  };
  struct Antenna {
    std::string name;
    int link = 0;
    Vec3 p_BS_m = Vec3::Zero();
    std::vector<double> by_machine = {}, by_site = {};  ///< one per moment
    std::vector<double> hidden_moments = {};            ///< one per cell
  };

  std::size_t machine_;
  std::vector<Direction> sky_;
  std::vector<Antenna> antennas_;
};

}  // namespace tera
