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
  double sinkage_m = 0;   ///< greatest sinkage of a part
  double grip_n = 0;      ///< shear strength of the ground below
  double weight_n = 0;    ///< sum of the normal forces
  double forward_w = 0;   ///< sum of normal force times forward speed
  double contact_m = 0;   ///< length of the ground under the gear

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

/// Effective depth of the lower edge of a face at p_W_m below the ground there.
double DepthBeside_m(const PushedFace& face, const Vec3& p_W_m, const Columns& ground);

/// A rigid wheel on the ground.
///
/// Frames  W; B the frame of the gear's link.
/// Model   Stresses are integrated over the rim from entry to exit, at fixed angles of 2 deg. The
///         normal stress is elastic and limited by Rolling. Columns under the rim yield to it.
///         Shear: each angle has a shear displacement j that moves with the rim and is zero at
///         entry. Slip is relative to soil at rest, so that j is that of Wong and Reece. Resistance
///         comes from these stresses alone.
///         Sides: a sunk side that is pushed into soil meets passive pressure over its whole chord,
///         scaled by the sine of the slip angle. An obstacle low enough to climb bears like
///         pavement.
/// Omits   Soil carried to the rear, flexible tyres, wheels on their sides.
/// Source  Wong and Reece 1967, J. Terramechanics 4(1); Ishigami, Miwa, Nagatani and Yoshida 2007,
///         J. Field Robotics 24(3); the sine: Ishigami 2008, thesis, Tohoku University.
class WheelContact {
 public:
  /// `soils` are the soils of the ground, scaled by the footing of the machine, and the material of
  /// obstacles as the last one. They must outlive this object.
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
  std::vector<Plate> plates_;  ///< one for each soil
  double step_rad_;            ///< angle between nodes
  std::vector<Vec2> j_m_;      ///< shear displacement at each node
  /// for each strip across, positive in the direction of rolling
  std::vector<double> entry_rad_, front_rad_;
  RollingMemory memory_;
  Rolling rolling_;       ///< slip and skid in this step
  double pushed_m_ = 0;   ///< lateral displacement of its side into soil, to the left
  double contact_m_ = 0;  ///< length of the ground under the wheel
  double forward_mps_ = 0, aside_mps_ = 0;  ///< mean speed over the ground at the contact
  double deepest_m_ = 0;
};

}  // namespace tera
