#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "core/motion.h"
#include "core/types/ground_tools.h"
#include "soil/columns/columns.h"
#include "soil/track/low_obstacles.h"
#include "soil/track/plate.h"
#include "soil/track/rim.h"
#include "soil/track/rolling.h"
#include "soil/track/rut.h"

namespace tera {

/// Sum over the parts of a gear on the ground.
struct GearSum {
  Wrench wrench;          ///< about the link's origin
  double traction_n = 0;  ///< shear along the machine's forward travel
  double sinkage_m = 0;   ///< of the lowest
  double grip_n = 0;      ///< shear strength of the ground below
  double weight_n = 0;    ///< normal forces
  double forward_w = 0;   ///< times the speed ahead at each
  double contact_m = 0;   ///< length of the ground under it

  void Add(const GearSum& other) {
    wrench.force_W_n += other.wrench.force_W_n;
    wrench.torque_W_nm += other.wrench.torque_W_nm;
    traction_n += other.traction_n;
    sinkage_m = std::max(sinkage_m, other.sinkage_m);
    grip_n += other.grip_n;
    weight_n += other.weight_n;
    forward_w += other.forward_w;
    contact_m += other.contact_m;
  }
};

/// Depth that counts of a face's lower edge, at p_W_m, below the ground there.
double DepthBeside_m(const PushedFace& face, const Vec3& p_W_m, const Columns& ground);

/// A rigid wheel on the ground.
///
/// Frames  W; B the frame of the gear's link.
/// Model   Stresses are integrated around the rim between its entry into the ground and its exit,
///         at fixed angles, finer than the ground's cells show. The normal stress is elastic, at
///         most Rolling's. Columns under the rim give way to it. Shear: each angle has a shear
///         displacement j, carried along by the rim and zero where it enters; slip is over soil at
///         rest, so that j is Wong and Reece's. Resistance is that of the stresses alone.
///         Sides: the sunk side that is pushed into soil meets passive pressure on its whole chord,
///         in proportion to the sine of its slip angle.
///         An obstacle low enough to be climbed bears it as pavement does.
/// Omits   soil that it carries out behind it; tyre flexibility; wheels that lean on their sides.
/// Source  Wong and Reece 1967, J. Terramechanics 4(1); Ishigami, Miwa, Nagatani and Yoshida 2007,
///         J. Field Robotics 24(3); the sine: Ishigami 2008, thesis, Tohoku University.
class WheelContact {
 public:
  /// `soils` are those of the ground, as the machine meets them, and last that of obstacles; they
  /// outlive it.
  WheelContact(const Rim& rim, const RunningGear& gear, bool shears,
               const std::vector<SoilType>& soils);

  GearSum Act(const BodyState& body, double shoe_mps, double dt_s, const LowObstacles& obstacles,
              Columns* ground, Rut* rut);

 private:
  struct Node;
  struct Sample;
  void PressRut(const BodyState& body, const LowObstacles& obstacles, Columns* ground,
                Rut* rut) const;
  void Sink(ColumnId k, const Rim::Over& rim, double down, const Vec2& left_W, Columns* ground,
            Rut* rut) const;
  double FindEntry_rad(double front_rad, double across_m, const BodyState& body,
                       const Columns& ground) const;
  std::optional<Sample> SampleAt(const Rim::Point& at, const Columns& ground,
                                 const LowObstacles& obstacles) const;
  Node Bear(double angle_rad, const BodyState& body, const Columns& ground,
            const LowObstacles& obstacles);
  void Shear(std::size_t k, const Node& node, double shoe_mps, double dt_s, const BodyState& body,
             const std::vector<Vec2>& before_m, GearSum* sum);
  void PushAside(const BodyState& body, double dt_s, const Columns& ground, GearSum* sum);
  double side() const { return rolling_.rolled < 0 ? -1 : 1; }
  std::size_t StripAt(double across_m) const;

  Rim rim_;
  double grouser_m_, climb_m_;
  bool shears_;
  std::span<const SoilType> soils_;
  std::vector<Plate> plates_;                  ///< one for each soil
  double step_rad_;                            ///< between nodes
  std::vector<Vec2> j_m_;                      ///< shear displacement at each node
  std::vector<double> entry_rad_, front_rad_;  ///< of each strip across, to the side it rolls to
  RollingMemory memory_;
  Rolling rolling_;                         ///< of this step
  double pushed_m_ = 0;                     ///< by its side into the soil beside it, to the left
  double contact_m_ = 0;                    ///< length of the ground under it
  double forward_mps_ = 0, aside_mps_ = 0;  ///< over the ground where it bears
  double deepest_m_ = 0;
};

}  // namespace tera
