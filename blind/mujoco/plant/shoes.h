#pragma once

#include "blind/mujoco/plant/model.h"

namespace tera::blind::mujoco {

/// The ground under eight shoes of each track.
///
/// Model   A shoe is carried by a spring and damper along the ground's normal. Along and across the
///         track it hangs on a bristle z: z' = v - z |V| / l, v being what it slides, V the track's
///         speed and l a length of ground; its force k z + c z' is at most the grip times the load.
///         So tracks stand on slopes without creeping, a thrust costs slip in proportion, and turns
///         slide the shoes sideways. Rolling resistance pulls at the machine against its travel, as
///         a blade does that scrapes along. Mud packs on a sprocket within kPacks_m of way.
/// Omits   sinkage; that a shoe that slides one way holds less the other way.
class Shoes {
 public:
  Shoes(const MachineNumbers& numbers, const PlantForm& form, const Ground& ground, double mass_kg);

  /// Adds to what is applied from outside, over the step that comes.
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
  /// Adds what one shoe does to the force and to the torque about the base's origin.
  void PushShoe(const Mat3& R_WB, const Vec3& p_WB_m, const Vec3& v_mps, const Vec3& w_radps,
                std::size_t k, Side* side, Vec3* force_n, Vec3* torque_nm) const;
  double Radius_m(std::size_t side) const;
  /// Of a blade, at the height of the ground before the tracks: no torque about that point.
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
