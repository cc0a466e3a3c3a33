#pragma once

#include <cstdint>
#include <vector>

#include "core/types/ground_tools.h"
#include "soil/columns/columns.h"
#include "soil/track/low_obstacles.h"
#include "soil/track/plate.h"
#include "soil/track/tread.h"

namespace tera {

/// A patch of running gear where it stands.
///
/// Frames  W.
struct Footprint {
  Footprint(const ContactPatch& patch, const Pose& X_WB)
      : p_W_m(X_WB * patch.p_B_m),
        n_W(X_WB.linear() * patch.outward_B),
        along_W(X_WB.linear() * patch.travel_B),
        across_W(n_W.cross(along_W)) {}

  Vec3 p_W_m;     ///< its middle
  Vec3 n_W;       ///< outward, into the ground
  Vec3 along_W;   ///< along the shoes' travel when the gear drives forward
  Vec3 across_W;  ///< right-handed with n_W and along_W
};

/// Running gear's work on the columns under it: it presses a rut and carries soil away.
///
/// Frames  W; patches in the frame B of the gear's link.
/// Model   Columns under a patch give way plastically until its elastic pressure, with its peaks
///         under road wheels, equals Bekker's. They remember that pressure for later passes. Height
///         becomes density, as far as the pressure presses soil together. The rest heaves beside
///         the gear, most at its edge and none beyond the exit of Prandtl's slip surface. It heaves
///         in parcels whose places follow the golden section. Soil
///         between grousers goes with the shoes. Where they slip over the ground, a layer as thick
///         as they are high, at most their sinkage, leaves at the end to which it is carried. The
///         gear sinks by as much, evenly over its contact: h i / (1 - i) in a pass at slip i. The
///         ground keeps its memory of pressure thereby. Ground that comes free gets the print of
///         the grousers, see Tread.
/// Omits   soil that grousers carry sideways.
/// Source  Bekker 1969; memory and grid as in Krenn and Hirzinger 2009; slip sinkage: Reece 1965.
class Rut {
 public:
  /// `soils` are those of the ground, as the machine meets them.
  Rut(const RunningGear& gear, const std::vector<SoilType>& soils);
  Rut(Rut&&) = default;  // a copy's plates would be on the original's soils

  /// Before a step's patches, in which the shoes move on by `shoe_m`.
  void Begin(double shoe_m, Columns* ground);
  /// Presses the columns under patch `k`, which stands at `foot`, where they cannot bear it and no
  /// low obstacle lies on them; of a side face under the share `touching`, see SideFaces. Returns
  /// the work of it that the patch's pressure does not do, because the gear moves on rather than
  /// down.
  double Press(std::size_t k, const Footprint& foot, double touching, const BodyState& body,
               double dt_s, const LowObstacles& obstacles, Columns* ground);
  /// The gear stands over a column, from `low_m` upwards.
  void Cover(ColumnId k, double low_m, Columns* ground);
  /// Ground beside a gear's edge in which soil heaves.
  struct Beside {
    Vec2 edge_W_m;   ///< of its first column
    Vec2 out_W;      ///< away from the gear, of length 1
    double reach_m;  ///< from there
  };
  /// Presses a column's surface; soil that is not pressed together heaves.
  void Lower(ColumnId k, const Pressing& pressing, const Beside& beside, Columns* ground);
  /// Lets patch `k`, whose columns were just pressed, slip by `slip_m` over them, along travel;
  /// `contact_m` is the length of ground under the whole gear.
  /// Its shoes stand `sinkage_m` deep.
  void Slip(std::size_t k, double slip_m, double sinkage_m, double contact_m, const BodyState& body,
            Columns* ground);
  /// After a step's patches, which carry `weight_n`: it loads the columns below, and soil may slide
  /// again into those that the gear has left.
  void End(const BodyState& body, double weight_n, Columns* ground);

 private:
  struct Under;
  static double RowShare(const Under& column, double cell_m);
  Beside BesideOf(const Under& column, const Plate& plate, double cell_m) const;
  double Sink(const Under& column, double pen_m, const BodyState& body, double dt_s,
              Columns* ground);
  void ThrowOut(double direction, const BodyState& body, const SpoilMix& thrown, Columns* ground);

  RunningGear gear_;
  std::vector<SoilType> soils_;
  std::vector<Plate> plates_;
  Tread tread_;
  std::vector<double> scrape_m_;   ///< of each patch: still to be carried away, signed as its slip
  std::uint32_t heaved_ = 0;       ///< parcels so far
  std::vector<ColumnId> pressed_;  ///< columns under the patch just pressed
  std::vector<std::size_t> touching_, was_touching_;  ///< patches on the ground
  std::vector<ColumnId> covered_, was_covered_;       ///< columns under the gear
};

}  // namespace tera
