#pragma once

#include "core/motion.h"
#include "physics/description/machine.h"

namespace tera {

/// Kinetic energy of a machine's links.
inline double KineticEnergy_j(const MachineModel& model, const MachineState& state) {
  double energy_j = 0;
  for (std::size_t k = 0; k < state.links.size(); ++k) {
    const Link& link = model.links[k];
    const BodyState& body = state.links[k];
    const Vec3 w_B_radps = body.X_WB.linear().transpose() * body.w_WB_radps;
    energy_j += 0.5 * link.mass_kg * PointVelocity(body, link.com_B_m).squaredNorm() +
                0.5 * w_B_radps.dot(link.inertia_B_kgm2 * w_B_radps);
  }
  return energy_j;
}

}  // namespace tera
