#include "blind/mujoco/plant/drives.h"

#include <algorithm>
#include <cmath>

namespace tera::blind::mujoco {
namespace {

constexpr double kWave_radprad = 8;  ///< of a gain that goes up and down with the angle
constexpr double kWarming_s = 15;
constexpr double kLoadSeen_s = 0.05;   ///< within which a pump's regulator sees a load
constexpr double kEdge = 0.004;        ///< of levers, over which a spool's edge is rounded
constexpr double kCreep_radps = 0.01;  ///< below which dry friction is that of rest

double SignOf(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

}  // namespace

Drives::Drives(const MachineNumbers& numbers, const PlantForm& form, const Stream& messages)
    : full_rate_radps_(numbers.full_rate_radps), forms_(form.drives), messages_(messages) {}

/// Losses come in rows of a geometric length, whose mean the form has.
bool Drives::IsLost(std::size_t axis, std::uint64_t number) {
  const BusForm& bus = forms_[axis].bus;
  if (bus.lost <= 0) return false;
  const double ends = 1 / bus.lost_in_row;
  const double begins = ends * bus.lost / (1 - bus.lost);
  const double draw = messages_.Uniform(number, static_cast<std::uint32_t>(axis));
  Line& line = lines_[axis];
  line.losing = draw < (line.losing ? 1 - ends : begins);
  return line.losing;
}

void Drives::Send(double t_s, const PerAxis<double>& levers) {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    if (IsLost(i, sent_)) continue;
    const BusForm& bus = forms_[i].bus;
    const auto lane = static_cast<std::uint32_t>(kAxisCount + i);
    const double own_s = bus.jitter_s * std::abs(messages_.Gaussian(sent_, lane));
    double at_s = t_s + (bus.line_stages > 0 ? 0 : bus.delay_s) + own_s;
    std::deque<Message>& queue = lines_[i].under_way;
    if (!queue.empty()) at_s = std::max(at_s, queue.back().at_s);
    queue.push_back({at_s, levers[i]});
  }
  ++sent_;
}

double Drives::Valve(std::size_t axis, double lever) {
  const DriveForm& form = forms_[axis];
  double& spool = lines_[axis].spool;
  if (form.sticking > 0 && lever != 0) {
    // What friction holds is dragged along at a distance.
    spool = std::clamp(spool, lever - form.sticking, lever + form.sticking);
  } else {
    spool = lever;
  }
  const double overlap = form.overlap * (1 + form.overlap_skew * SignOf(spool));
  const double open = std::abs(spool) - overlap;
  const double past = (open + std::sqrt(open * open + kEdge * kEdge)) / 2;
  const double closed = (-overlap + std::sqrt(overlap * overlap + kEdge * kEdge)) / 2;
  const double given = std::min(past - closed, form.end);
  return SignOf(spool) * given * (spool < 0 ? form.negative : 1);
}

double Drives::AskedRate_radps(std::size_t axis, double t_s, double valve, double angle_rad,
                               const Model& model, const mjData& data) {
  const DriveForm& form = forms_[axis];
  Line& line = lines_[axis];
  const double load_nm = data.actuator_force[model.drive[axis]];
  line.load_nm += kStep_s / kLoadSeen_s * (load_nm - line.load_nm);
  const double rated = line.load_nm / model.rated_nm[axis];
  double share = form.gain * (1 + form.wave * std::sin(kWave_radprad * angle_rad));
  share *= 1 - form.cold_share * std::exp(-std::max(0.0, t_s) / kWarming_s);
  share *= std::clamp(1 - form.droop * rated * SignOf(valve), 0.0, 1.5);
  if (form.slowed_by >= 0) {
    const double other = std::abs(lines_[static_cast<std::size_t>(form.slowed_by)].lever);
    share *= 1 - form.slowed_share * std::min(1.0, other / 0.3);
  }
  const double leaked = form.leak * rated;
  return full_rate_radps_[axis] * (valve * share - leaked);
}

void Drives::Command(double t_s, const PerAxis<double>& angle_rad, Model* model, mjData* data) {
  mjModel* m = model->model.get();
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
    lever = Valve(i, lever);
    through(model->pilot[i]);
    if (model->second_pilot[i] >= 0) through(model->second_pilot[i]);
    data->ctrl[model->drive[i]] = AskedRate_radps(i, t_s, lever, angle_rad[i], *model, *data);
    if (form.motor_s <= 0) continue;
    const int dof = m->jnt_dofadr[model->joint[i]];
    const double rest = std::exp(-std::pow(data->qvel[dof] / kCreep_radps, 2));
    m->dof_frictionloss[dof] = form.friction * full_rate_radps_[i] *
                               m->actuator_gainprm[model->drive[i] * mjNGAIN] *
                               (1 + (form.breakaway - 1) * rest);
  }
}

}  // namespace tera::blind::mujoco
