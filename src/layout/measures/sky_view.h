#pragma once

#include <string>
#include <vector>

#include "core/motion.h"
#include "layout/measures/figure.h"
#include "layout/measures/polar_map.h"
#include "layout/sight/sighting.h"
#include "sensors/sensor.h"

namespace tera {

/// The sky above an antenna, divided into cells of equal width in azimuth and elevation.
///
/// Frames  A lies at the antenna, stands upright and has the heading of the antenna's link. Azimuth
///         0 is ahead and increases counterclockwise, seen from above. Ring 0 is at the zenith.
struct SkyGrid {
  static constexpr int kSectors = 72, kRings = 18;
  static constexpr double kRing_deg = 5;

  static std::size_t Index(int sector, int ring) {
    return static_cast<std::size_t>(sector) * kRings + ring;
  }
};

/// Share of the sky that is hidden from each GNSS antenna of a layout, at each moment.
///
/// Frames  A as in SkyGrid.
/// Model   the sky is the hemisphere above an elevation mask; shares are of its solid angle. Each
///         cell has one ray from the antenna, drawn uniformly over the cell's solid angle and fixed
///         over time. The first surface on the ray hides the cell's part of the sky.
///         If that surface is the antenna's own machine or its load, the cell counts as hidden by
///         the machine. If it is anything else (ground, truck, tree, other machine), the cell
///         counts as hidden by the site. A layout can change only the first share. The total is the
///         sum of both.
/// Omits   diffraction; transmission through leaves, glass or plastics; the satellites' positions;
///         reflected signals.
/// Source  the mask lies between common defaults: 7 degrees (NavCom, "Sapphire technical reference
///         manual", rev. J, NAVELEVMASK) and 13 (Trimble Business Center's help, "elevation mask").
class SkyView {
 public:
  static constexpr double kMask_deg = 10;

  /// Uses the antennas among `sensors`, mounted on machine number `machine`. Directions below
  /// `mask_deg` do not count; a cell that the mask cuts counts with its part above the mask.
  SkyView(const MachineModel& model, std::size_t machine,
          const std::vector<SensorDescription>& sensors, double mask_deg = kMask_deg);

  /// Adds the moment that `sighting` shows. `machine` is the machine's state at that moment.
  void Add(const MachineState& machine, const Sighting& sighting);

  /// "sky/ANTENNA/hidden" by the machine, and "sky/ANTENNA/hidden_by_site".
  std::vector<Figure> Figures() const;
  /// "sky/ANTENNA/hidden": share of the moments at which the machine hides each cell, by
  /// SkyGrid::Index; negative below the mask.
  std::vector<PolarMap> Maps() const;

 private:
  /// A tested direction with the part of the sky that it represents.
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
    /// For each cell, the number of moments when it is hidden.
    std::vector<double> hidden_moments = {};
  };

  std::size_t machine_;
  std::vector<Direction> sky_;
  std::vector<Antenna> antennas_;
};

}  // namespace tera
