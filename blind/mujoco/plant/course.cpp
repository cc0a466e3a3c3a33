#include "blind/mujoco/plant/course.h"

#include <algorithm>
#include <cmath>

#include "blind/mujoco/plant/drives.h"
#include "blind/mujoco/plant/model.h"
#include "blind/mujoco/plant/shoes.h"

namespace tera::blind::mujoco {
namespace {

constexpr int kSettle_steps = 1500;
constexpr int kLever_steps = 20;

/// Places and rates; what sensors say comes with the forces of the step.
void Look(const Model& model, const mjData& data, Instant* out) {
  const mjModel* m = model.model.get();
  out->p_WB_m = Eigen::Map<const Vec3>(data.qpos);
  out->q_WB = Quat(data.qpos[3], data.qpos[4], data.qpos[5], data.qpos[6]);
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    out->angle_rad[i] = data.qpos[m->jnt_qposadr[model.joint[i]]];
    out->rate_radps[i] = data.qvel[m->jnt_dofadr[model.joint[i]]];
    if (model.gap[i] < 0) continue;
    out->angle_rad[i] += data.qpos[m->jnt_qposadr[model.gap[i]]];
    out->rate_radps[i] += data.qvel[m->jnt_dofadr[model.gap[i]]];
  }
}

void Sense(const Model& model, const mjData& data, Instant* out) {
  for (std::size_t u = 0; u < kUnits; ++u) {
    out->gyro_radps[u] = Eigen::Map<const Vec3>(data.sensordata + model.gyro[u]);
    out->accelerometer_mps2[u] = Eigen::Map<const Vec3>(data.sensordata + model.accelerometer[u]);
  }
  for (std::size_t r = 0; r < kReceivers; ++r) {
    out->antenna_m[r] = Eigen::Map<const Vec3>(data.sensordata + model.antenna[r]);
  }
}

}  // namespace

const Instant& Course::At(double t_s) const {
  const double row = std::round((t_s - from_s) / kStep_s);
  const double last = static_cast<double>(instants.size() - 1);
  return instants[static_cast<std::size_t>(std::clamp(row, 0.0, last))];
}

Course Drive(const MachineNumbers& numbers, const PlantForm& form, const Start& start,
             double duration_s, const Operator& someone, const Stream& messages) {
  Model model = BuildModel(numbers, form, start);
  const DataPtr data(mj_makeData(model.model.get()));
  PlaceAt(model, start, data.get());
  Shoes shoes(numbers, form, start.ground, mj_getTotalmass(model.model.get()));
  Drives drives(numbers, form, messages);
  Course course;
  course.from_s = -kSettle_steps * kStep_s;
  const int steps = static_cast<int>(duration_s / kStep_s);
  for (int k = -kSettle_steps; k <= steps; ++k) {
    const double t_s = k * kStep_s;
    mj_step1(model.model.get(), data.get());
    Instant now;
    Look(model, *data, &now);
    if (k >= 0 && k % kLever_steps == 0) {
      course.levers.rows.push_back(someone(t_s, now));
      drives.Send(t_s, course.levers.rows.back());
    }
    drives.Command(t_s, now.angle_rad, &model, data.get());
    mju_zero(data->qfrc_applied, model.model->nv);
    shoes.Push(model, data.get());
    mj_step2(model.model.get(), data.get());
    Sense(model, *data, &now);
    course.instants.push_back(now);
  }
  return course;
}

Operator Replayed(const Levers& levers) {
  return [&levers](double t_s, const Instant&) {
    const auto row = static_cast<std::size_t>(std::llround(t_s / levers.period_s));
    return levers.rows[std::min(row, levers.rows.size() - 1)];
  };
}

}  // namespace tera::blind::mujoco
