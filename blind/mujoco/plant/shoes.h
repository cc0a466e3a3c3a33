#pragma once

#include "blind/mujoco/plant/model.h"

namespace tera::blind::mujoco {

/// The ground under eight shoes of each track.
///
/// Model   A shoe is carried by a spring and damper along the ground's normal. Along and across the
///         track it hangs on a bristle z: z' = v - z |V| / l, v being what it slides, V the track's
///         speed and l a length of ground; its force k z + c z' is at most the grip times the load.
///         So tracks stand on slopes without creeping, a thrust costs slip in proportion, and turns
///         slide the shoes sideways. Rolling resistance pulls at the machine against its travel.
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
    double y_m = 0, speed_mps = 0, thrust_n = 0;
    std::array<Bristle, kShoes> bristles;
  };
  /// Adds what one shoe does to the force and to the torque about the base's origin.
  void PushShoe(const Mat3& R_WB, const Vec3& p_WB_m, const Vec3& v_mps, const Vec3& w_radps,
                std::size_t k, Side* side, Vec3* force_n, Vec3* torque_nm) const;

  const Ground& ground_;
  ShoeForm form_;
  double contact_m_, carry_npm_, carry_nspm_, bristle_npm_, bristle_nspm_;
  std::array<double, 2> radius_m_;
  std::array<Side, 2> sides_;
};

}  // namespace tera::blind::mujoco
