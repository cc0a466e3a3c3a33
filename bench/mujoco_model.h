#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

#include "physics/description/machine.h"

namespace tera::bench {

struct MujocoDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using MujocoModel = std::unique_ptr<mjModel, MujocoDeleter>;
using MujocoData = std::unique_ptr<mjData, MujocoDeleter>;

/// The machine's links and joints in MuJoCo: the same tree, inertias, stops and effort-limited
/// velocity motors, on a free base. It has no geometry, so no contacts.
MujocoModel InMujoco(const MachineModel& machine, double dt_s);

}  // namespace tera::bench
