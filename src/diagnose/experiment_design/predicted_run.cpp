#include "diagnose/experiment_design/predicted_run.h"

#include <algorithm>
#include <cmath>

#include "diagnose/blocks/axis_block.h"
#include "physics/actuation/actuation.h"
#include "physics/dynamics/gravity_load.h"

namespace tera {
namespace {

/// The load of the links' weight on joints hardly changes in this time.
constexpr double kLoadPeriod_s = 0.05;
/// Amplitude of a tremor that keeps consecutive rates from being equal. Equal rates would count as
/// samples that an encoder holds.
constexpr double kTremor_radps = 1e-9;

std::size_t AxesOf(const MachineModel& model) {
  return model.joints.size() + model.gear_drives.size();
}

/// The levers of all axes as moves set them, read with rising time.
class LeversOverTime {
 public:
  LeversOverTime(const MachineModel& model, const std::vector<LeverMove>& moves)
      : moves_(moves), now_(AxesOf(model), 0.0) {
    std::stable_sort(moves_.begin(), moves_.end(),
                     [](const LeverMove& a, const LeverMove& b) { return a.t_s < b.t_s; });
  }
  const std::vector<double>& At(double t_s) {
    while (next_ < moves_.size() && moves_[next_].t_s <= t_s + 1e-9) {
      now_[moves_[next_].axis] = moves_[next_].lever;
      ++next_;
    }
    return now_;
  }

 private:
  std::vector<LeverMove> moves_;
  std::vector<double> now_;
  std::size_t next_ = 0;
};

/// Commands with a row at each lever move. All levers are in neutral at the end.
TableRecording CommandsOf(const MachineModel& model, const std::vector<LeverMove>& moves,
                          double length_s) {
  TableRecording table;
  for (const Lever& lever : model.levers) table.columns.push_back(lever.name);
  std::vector<double> times = {0, length_s};
  for (const LeverMove& move : moves) times.push_back(move.t_s);
  std::sort(times.begin(), times.end());
  LeversOverTime levers(model, moves);
  std::vector<double> last;
  for (const double t_s : times) {
    const std::vector<double>& now = levers.At(t_s);
    std::vector<double> row;
    for (const Lever& lever : model.levers) row.push_back(now[AxisOf(model, lever)]);
    const TimeNs t_ns = FromSeconds(t_s);
    if (!table.t_ns.empty() && (t_ns <= table.t_ns.back() || (row == last && t_s < length_s))) {
      if (t_ns == table.t_ns.back()) table.rows.back() = last = row;
      continue;
    }
    table.t_ns.push_back(t_ns);
    table.rows.push_back(row);
    last = row;
  }
  return table;
}

void Measure(const std::vector<AxisMotion>& motion, std::size_t sample, double t_s,
             EncoderRecording* encoders) {
  EncoderSample measured;
  measured.t_ns = measured.t_available_ns = FromSeconds(t_s);
  const double tremor_radps = sample % 2 == 0 ? kTremor_radps : -kTremor_radps;
  for (const AxisMotion& axis : motion) {
    measured.q_rad.push_back(axis.position_rad);
    measured.qd_radps.push_back(axis.rate_radps + tremor_radps);
  }
  encoders->samples.push_back(std::move(measured));
}

}  // namespace

PredictedRun PredictRun(const MachineModel& model, const std::vector<LeverMove>& moves,
                        double length_s, std::vector<double> start_rad, double period_s) {
  PredictedRun out;
  out.length_s = length_s;
  out.commands = CommandsOf(model, moves, length_s);
  out.encoders.channel = "predicted_run/encoders";
  for (const Joint& joint : model.joints) {
    out.encoders.recording.axes.push_back({joint.name, joint.type == JointType::kPrismatic});
  }
  for (std::size_t g = 0; g < model.gear_drives.size(); ++g) {
    out.encoders.recording.axes.push_back({model.ground_tools.gears[g].name});
  }
  std::vector<AxisMotion> motion(AxesOf(model));
  for (std::size_t j = 0; j < start_rad.size(); ++j) motion[j].position_rad = start_rad[j];
  out.lowest_rad = out.highest_rad = start_rad;
  Actuation chain(model, {.machine = model.kind});
  LeversOverTime levers(model, moves);
  const auto count = static_cast<std::size_t>(std::lround(length_s / kReplayStep_s));
  const auto load_stride =
      static_cast<std::size_t>(std::max(1.0, std::round(kLoadPeriod_s / kReplayStep_s)));
  double next_sample_s = 0;
  for (std::size_t k = 0; k <= count; ++k) {
    const double t_s = static_cast<double>(k) * kReplayStep_s;
    if (k % load_stride == 0) {
      for (std::size_t j = 0; j < start_rad.size(); ++j) start_rad[j] = motion[j].position_rad;
      const std::vector<double> loads = GravityLoads_nm(model, Pose::Identity(), start_rad);
      for (std::size_t j = 0; j < loads.size(); ++j) motion[j].load_nm = loads[j];
    }
    if (t_s + 1e-9 >= next_sample_s) {
      Measure(motion, out.encoders.recording.samples.size(), t_s, &out.encoders.recording);
      next_sample_s += period_s;
    }
    chain.Step(levers.At(t_s), motion, kReplayStep_s);
    for (std::size_t axis = 0; axis < motion.size(); ++axis) {
      motion[axis].rate_radps = chain.drives()[axis].rate_radps;
      motion[axis].position_rad += motion[axis].rate_radps * kReplayStep_s;
    }
    for (std::size_t j = 0; j < out.lowest_rad.size(); ++j) {
      out.lowest_rad[j] = std::min(out.lowest_rad[j], motion[j].position_rad);
      out.highest_rad[j] = std::max(out.highest_rad[j], motion[j].position_rad);
    }
  }
  for (std::size_t j = 0; j < out.lowest_rad.size(); ++j) {
    out.end_rad.push_back(motion[j].position_rad);
  }
  return out;
}

PredictedRun Concatenated(const std::vector<PredictedRun>& runs) {
  PredictedRun out;
  for (const PredictedRun& run : runs) {
    const TimeNs late_ns = FromSeconds(out.length_s);
    if (out.commands.columns.empty()) {
      out = run;
      continue;
    }
    for (std::size_t r = 0; r < run.commands.rows.size(); ++r) {
      const TimeNs t_ns = run.commands.t_ns[r] + late_ns;
      if (t_ns <= out.commands.t_ns.back()) {
        out.commands.rows.back() = run.commands.rows[r];
        continue;
      }
      out.commands.t_ns.push_back(t_ns);
      out.commands.rows.push_back(run.commands.rows[r]);
    }
    for (EncoderSample sample : run.encoders.recording.samples) {
      sample.t_ns += late_ns;
      sample.t_available_ns += late_ns;
      auto& samples = out.encoders.recording.samples;
      if (sample.t_ns > samples.back().t_ns) samples.push_back(std::move(sample));
    }
    out.length_s += run.length_s;
    out.end_rad = run.end_rad;
    for (std::size_t j = 0; j < out.lowest_rad.size(); ++j) {
      out.lowest_rad[j] = std::min(out.lowest_rad[j], run.lowest_rad[j]);
      out.highest_rad[j] = std::max(out.highest_rad[j], run.highest_rad[j]);
    }
  }
  return out;
}

std::optional<ReplayBlock> BlockOf(const MachineModel& model, const PredictedRun& run,
                                   std::size_t axis) {
  const AxisLog log = MakeAxisLog(model, run.commands, {run.encoders}, kReplayStep_s);
  for (std::size_t m = 0; m < log.measured.size(); ++m) {
    if (log.measured[m].axis == axis) return MakeAxisBlock(model, log, m);
  }
  return std::nullopt;
}

}  // namespace tera
