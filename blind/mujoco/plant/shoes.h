#pragma once

#include "blind/mujoco/plant/model.h"

namespace tera::blind::mujoco {

/// The ground under eight shoes of each track.
///
/// Model   A spring and a damper along the ground's normal support each shoe. Along and across the
///         track it hangs on a bristle z: z' = v - z |V| / l. v is the sliding speed, V the track's
///         speed and l a length of ground. The force k z + c z' is at most the grip times the load.
///         So tracks hold on slopes without creep, thrust costs slip in proportion, and turns slide
///         the shoes sideways. Rolling resistance acts against the machine's travel, and so does a
///         scraping blade. Mud packs on a sprocket within kPacks_m of travel.
/// Omits   sinkage; the loss of grip across the direction of sliding.
class Shoes {
 public:
  Shoes(const MachineNumbers& numbers, const PlantForm& form, const Ground& ground, double mass_kg);

  /// Adds the ground's forces to the applied ones for the coming step.
  void Push(const Model& model, mjData* data);

 private:
  static constexpr std::size_t kShoes = 8;
  struct Bristle {
    double along_m = 0, across_m = 0;
  };
  struct Side {
    double y_m = 0, speed_mps = 0, thrust_n = 0, way_m = 0;
    double relaxation_m = 0;
    std::array<Bristle, kShoes> bristles;
  };
  /// Adds one shoe's force, and its torque about the base's origin.
  void PushShoe(const Mat3& R_WB, const Vec3& p_WB_m, const Vec3& v_mps, const Vec3& w_radps,
                std::size_t k, Side* side, Vec3* force_n, Vec3* torque_nm) const;
  double Radius_m(std::size_t side) const;
  /// Drag of a blade, at ground height in front of the tracks: no torque about that point.
  Vec3 Drag_n(const Vec3& ahead, const Vec3& v_mps) const;

  static constexpr double kPacks_m = 3;
  const Ground& ground_;
  ShoeForm form_;
  double contact_m_, carry_npm_, carry_nspm_, bristle_npm_, bristle_nspm_;
  double weight_n_;
  std::array<double, 2> radius_m_;  ///< clean
  Eigen::Vector2d packs_;
  std::array<Side, 2> sides_;
};

}  // namespace tera::blind::mujoco
