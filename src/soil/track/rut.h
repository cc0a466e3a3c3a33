#pragma once

#include <cstdint>
#include <vector>

#include "core/types/ground_tools.h"
#include "soil/columns/columns.h"
#include "soil/track/low_obstacles.h"
#include "soil/track/plate.h"
#include "soil/track/tread.h"

namespace tera {

/// A patch of running gear at its present pose.
///
/// Frames  W.
struct Footprint {
  Footprint(const ContactPatch& patch, const Pose& X_WB)
      : p_W_m(X_WB * patch.p_B_m),
        n_W(X_WB.linear() * patch.outward_B),
        along_W(X_WB.linear() * patch.travel_B),
        across_W(n_W.cross(along_W)) {}

  Vec3 p_W_m;     ///< middle of the patch
  Vec3 n_W;       ///< outward, into the ground
  Vec3 along_W;   ///< along the travel of the shoes when the gear drives forward
  Vec3 across_W;  ///< right-handed with n_W and along_W
};

/// Effect of running gear on the columns below: it presses a rut and carries soil away.
///
/// Frames  W; patches in the frame B of the gear's link.
/// Model   Columns under a patch yield plastically until its elastic pressure, with the peaks under
///         road wheels, equals Bekker's. They store this sinkage for later passes. Lost height
///         increases the density, up to the density that the pressure yields. The rest heaves
///         beside the gear. The heave decreases outwards and ends at the exit of Prandtl's slip
///         surface. It is placed in parcels at positions of the golden-ratio sequence.
///         Soil between grousers moves with the shoes. Where the shoes slip, they carry a layer to
///         the end of the contact. The layer is as thick as the grousers are high, at most the
///         sinkage. The gear sinks by this layer, evenly over its contact: h i / (1 - i) per pass
///         at slip i. The ground keeps its plastic sinkage. Ground that the track leaves gets the
///         print of the grousers, see Tread.
/// Omits   Soil that grousers carry sideways.
/// Source  Bekker 1969; memory and grid as in Krenn and Hirzinger 2009; slip sinkage: Reece 1965.
class Rut {
 public:
  /// `soils` are the soils of the ground, scaled by the footing of the machine.
  Rut(const RunningGear& gear, const std::vector<SoilType>& soils);
  Rut(Rut&&) = default;  // a copied plate would refer to the soils of the original

  /// Starts a step in which the shoes move by `shoe_m`. Call it before the patches.
  void Begin(double shoe_m, Columns* ground);
  /// Presses those columns under patch `k` that yield under its pressure. A column below a low
  /// obstacle is skipped. `touching` is the share of a side face that touches, see SideFaces.
  /// Returns the part of the work on the rut that comes from forward motion. The sinking of the
  /// patch does the rest.
  double Press(std::size_t k, const Footprint& foot, double touching, const BodyState& body,
               double dt_s, const LowObstacles& obstacles, Columns* ground);
  /// Marks a column below the gear, which stands above `low_m`.
  void Cover(ColumnId k, double low_m, Columns* ground);
  /// The ground beside the edge of a gear, where soil heaves.
  struct Beside {
    Vec2 edge_W_m;   ///< start of the heave, at its first column
    Vec2 out_W;      ///< unit vector away from the gear
    double reach_m;  ///< length of the heave from there
  };
  /// Presses the surface of a column. Soil that is not compacted heaves.
  void Lower(ColumnId k, const Pressing& pressing, const Beside& beside, Columns* ground);
  /// Lets patch `k` slip by `slip_m` along its travel over the columns that it just pressed.
  /// `contact_m` is the length of ground under the whole gear, `sinkage_m` the sinkage of the
  /// shoes.
  void Slip(std::size_t k, double slip_m, double sinkage_m, double contact_m, const BodyState& body,
            Columns* ground);
  /// Ends a step in which the gear carries `weight_n`. Loads the columns below and frees those that
  /// the gear has left.
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
  /// for each patch: layer still to be carried away, with the sign of the slip
  std::vector<double> scrape_m_;
  std::uint32_t heaved_ = 0;                          ///< number of parcels so far
  std::vector<ColumnId> pressed_;                     ///< columns under the patch just pressed
  std::vector<std::size_t> touching_, was_touching_;  ///< patches on the ground
  std::vector<ColumnId> covered_, was_covered_;       ///< columns under the gear
};

}  // namespace tera
