#include "blind/mujoco/plant/drives.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "blind/mujoco/plant/slew_ring.h"

namespace tera::blind::mujoco {
namespace {

constexpr double kWave_radprad = 8;  ///< of a gain that goes up and down with the angle
constexpr double kWarming_s = 15;
constexpr double kLoadSeen_s = 0.05;   ///< within which a pump's regulator sees a load
constexpr double kEdge = 0.004;        ///< of levers, over which a spool's edge is rounded
constexpr double kRing = 0.7;          ///< diameter of a slewing ring over the gauge
constexpr double kCreep_radps = 0.01;  ///< below which dry friction is that of rest

double SignOf(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

}  // namespace

Drives::Drives(const MachineNumbers& numbers, const PlantForm& form, const Stream& messages)
    : full_rate_radps_(numbers.full_rate_radps),
      ring_m_(kRing * numbers.gauge_m),
      forms_(form.drives),
      messages_(messages) {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const DriveForm& drive = forms_[i];
    const auto lane = static_cast<std::uint32_t>(2 * kAxisCount + 3 * i);
    Line& line = lines_[i];
    if (drive.bus.slot_s > 0) {
      line.arbitration.emplace(drive.bus.slot_s, drive.bus.contested, messages, lane);
    }
    if (drive.bus.fades_hz > 0) line.radio.emplace(drive.bus.fades_hz, messages, lane + 1);
    if (drive.line_s > 0) line.hose.emplace(drive.line_s);
    if (drive.runs_ahead > 0) line.falls.emplace(drive.runs_ahead);
    if (drive.brake_opens_s > 0) line.brake.emplace(drive.brake_opens_s);
  }
}

/// Losses come in rows of a geometric length, whose mean the form has, or as a radio fades.
bool Drives::IsLost(std::size_t axis, std::uint64_t number, double t_s) {
  const BusForm& bus = forms_[axis].bus;
  if (bus.lost <= 0) return false;
  Line& line = lines_[axis];
  if (line.radio) return line.radio->Loses(t_s, bus.lost);
  const double ends = 1 / bus.lost_in_row;
  const double begins = ends * bus.lost / (1 - bus.lost);
  const double draw = messages_.Uniform(number, static_cast<std::uint32_t>(axis));
  line.losing = draw < (line.losing ? 1 - ends : begins);
  return line.losing;
}

void Drives::Send(double t_s, const PerAxis<double>& levers) {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    if (IsLost(i, sent_, t_s)) continue;
    const BusForm& bus = forms_[i].bus;
    Line& line = lines_[i];
    const auto lane = static_cast<std::uint32_t>(kAxisCount + i);
    const double own_s = bus.jitter_s * std::abs(messages_.Gaussian(sent_, lane));
    double at_s = line.arbitration ? line.arbitration->SlotOf(sent_, t_s) : t_s;
    at_s += (bus.line_stages > 0 ? 0 : bus.delay_s) + own_s;
    std::deque<Message>& queue = line.under_way;
    if (!queue.empty()) at_s = std::max(at_s, queue.back().at_s);
    queue.push_back({at_s, levers[i]});
  }
  ++sent_;
}

double Drives::OpenSpool(const DriveForm& form, double spool) const {
  if (form.soft > 0) return std::abs(SoftStart(spool, form.overlap, form.soft));
  const double overlap = form.overlap * (1 + form.overlap_skew * SignOf(spool));
  const double open = std::abs(spool) - overlap;
  const double past = (open + std::sqrt(open * open + kEdge * kEdge)) / 2;
  const double closed = (-overlap + std::sqrt(overlap * overlap + kEdge * kEdge)) / 2;
  return past - closed;
}

double Drives::Valve(std::size_t axis, double lever) {
  const DriveForm& form = forms_[axis];
  double& spool = lines_[axis].spool;
  if (form.sticking > 0 && lever != 0) {
    // Friction holds the spool, which follows the lever at a distance.
    spool = std::clamp(spool, lever - form.sticking, lever + form.sticking);
  } else {
    spool = lever;
  }
  const double given = std::min(OpenSpool(form, spool), form.end);
  return SignOf(spool) * given * (spool < 0 ? form.negative : form.positive);
}

double Drives::Gain(std::size_t axis, double t_s, double angle_rad) const {
  const DriveForm& form = forms_[axis];
  double gain = form.gain * (1 + form.wave * std::sin(kWave_radprad * angle_rad));
  gain *= 1 + form.hunts * std::sin(2 * std::numbers::pi * form.hunts_hz * t_s);
  gain *= 1 - form.cold_share * std::exp(-std::max(0.0, t_s) / kWarming_s);
  if (form.slowed_by < 0) return gain;
  const double other = std::abs(lines_[static_cast<std::size_t>(form.slowed_by)].lever);
  return gain * (1 - form.slowed_share * std::min(1.0, other / 0.3));
}

double Drives::AskedRate_radps(std::size_t axis, double t_s, double valve, double angle_rad,
                               const Model& model, const mjData& data) {
  const DriveForm& form = forms_[axis];
  Line& line = lines_[axis];
  const double load_nm = data.actuator_force[model.drive[axis]];
  line.load_nm += kStep_s / kLoadSeen_s * (load_nm - line.load_nm);
  const double rated = line.load_nm / model.rated_nm[axis];
  double share = Gain(axis, t_s, angle_rad);
  share *= std::clamp(1 - form.droop * rated * SignOf(valve), 0.0, 1.5);
  share *= Counterbalance(form.lifting_droop, rated, valve);
  share *= Regeneration(form.regenerates, rated, valve);
  double asked = valve * share;
  if (line.falls) asked = line.falls->Rate(asked, rated, kStep_s);
  const double leaked = form.leak * rated;
  return full_rate_radps_[axis] * (asked - leaked);
}

void Drives::SetFriction(std::size_t axis, Model* model, const mjData& data) const {
  const DriveForm& form = forms_[axis];
  mjModel* m = model->model.get();
  const int joint = model->joint[axis], dof = m->jnt_dofadr[joint];
  const double rest = std::exp(-std::pow(data.qvel[dof] / kCreep_radps, 2));
  const double of_ring = form.ring_rubs ? RingFriction(*m, data, joint, ring_m_) : 1;
  m->dof_frictionloss[dof] = form.friction * full_rate_radps_[axis] *
                             m->actuator_gainprm[model->drive[axis] * mjNGAIN] * of_ring *
                             (1 + (form.breakaway - 1) * rest);
}

void Drives::Command(double t_s, const PerAxis<double>& angle_rad, Model* model, mjData* data) {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const DriveForm& form = forms_[i];
    Line& line = lines_[i];
    while (!line.under_way.empty() && line.under_way.front().at_s <= t_s + 1e-9) {
      line.lever = line.under_way.front().lever;
      line.under_way.pop_front();
    }
    double lever = line.lever;
    const auto through = [&](int filter) {
      data->ctrl[filter] = lever;
      lever = data->act[model->StateOf(filter)];
    };
    for (int k = 0; k < form.bus.line_stages; ++k) through(model->line[i].at(k));
    if (line.hose) lever = line.hose->After(kStep_s, lever);
    lever = Valve(i, lever);
    if (line.brake) lever *= line.brake->Share(t_s, lever);
    through(model->pilot[i]);
    if (model->second_pilot[i] >= 0) through(model->second_pilot[i]);
    data->ctrl[model->drive[i]] = AskedRate_radps(i, t_s, lever, angle_rad[i], *model, *data);
    if (form.motor_s > 0) SetFriction(i, model, *data);
    if (form.gap_worn > 0) {
      mjModel* m = model->model.get();
      const double motor_rad = data->qpos[m->jnt_qposadr[model->joint[i]]];
      const double half_rad =
          HalfPlay_rad(form.gap_rad, form.gap_worn, form.gap_worst_rad, motor_rad);
      m->jnt_range[2 * model->gap[i]] = -half_rad;
      m->jnt_range[2 * model->gap[i] + 1] = half_rad;
    }
  }
}

}  // namespace tera::blind::mujoco
