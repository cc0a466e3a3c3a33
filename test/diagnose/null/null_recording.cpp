#include "diagnose/null/null_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/random.h"
#include "core/units.h"
#include "diagnose/blocks/axis_block.h"
#include "diagnose/diagnose_blocks.h"
#include "diagnose/statistics/series/noise_model.h"
#include "diagnose/statistics/series/simulated.h"
#include "physics/actuation/actuation.h"
#include "physics/dynamics/gravity_load.h"
#include "physics/dynamics/joint_inertia.h"
#include "physics/machine_fixture.h"

namespace tera {
namespace {

constexpr double kPlantStep_s = 0.002;
constexpr int kStepsPerSample = 5;
constexpr int kStepsPerCommand = 10;
const std::array<std::string, 4> kJoints = {"boom", "arm", "bucket", "slew"};

MachineModel OffNominal(MachineModel model, const Stream& stream) {
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const double factor = 1 + 0.03 * (2 * stream.Uniform(j) - 1);
    model.joints[j].max_rate_positive_radps *= factor;
    model.joints[j].max_rate_negative_radps *= factor;
  }
  const double heavier = 1 + 0.03 * std::clamp(stream.Gaussian(1000), -2.0, 2.0);
  for (Link& link : model.links) {
    link.mass_kg *= heavier;
    link.inertia_B_kgm2 *= heavier;
  }
  return model;
}

/// A command to one joint for some time.
struct Gesture {
  enum class Kind { kRest, kStep, kRamp, kSine } kind = Kind::kRest;
  double size = 0, from_s = 0, to_s = 0;

  double At(double t_s) const {
    const double s = (t_s - from_s) / (to_s - from_s);
    switch (kind) {
      case Kind::kRest:
        return 0;
      case Kind::kStep:
        return s < 0.8 ? size : 0;
      case Kind::kRamp:
        return size * (1 - std::abs(2 * s - 1));
      case Kind::kSine:
        return size * std::sin(kPi * s);
    }
    return 0;
  }
};

/// Draws successive gestures of one joint, away from the nearer end stop.
class Hand {
 public:
  Hand(const Stream& stream, const Joint& joint) : stream_(stream), joint_(joint) {}

  double At(double t_s, double position_rad) {
    if (t_s >= now_.to_s) Next(t_s, position_rad);
    if (Stopping(now_.size, position_rad)) return 0;
    return now_.At(t_s);
  }

 private:
  bool Stopping(double lever, double position_rad) const {
    if (joint_.type == JointType::kContinuous || joint_.lower_rad >= joint_.upper_rad) return false;
    const double margin_rad = 0.1 * (joint_.upper_rad - joint_.lower_rad);
    return lever > 0 ? position_rad > joint_.upper_rad - margin_rad
                     : position_rad < joint_.lower_rad + margin_rad;
  }

  void Next(double t_s, double position_rad) {
    constexpr std::array kSizes = {0.08, 0.15, 0.25, 0.4, 0.6, 0.8, 1.0};
    const auto draw = [&](std::uint32_t lane) { return stream_.Uniform(count_, lane); };
    now_ = {Gesture::Kind::kRest, 0, t_s, t_s + 0.3 + 1.2 * draw(0)};
    if (draw(1) < 0.2) now_.to_s = t_s + 3.5;  // long enough to show the noise at rest
    if (count_++ % 2 == 0) return;
    const double size = kSizes[static_cast<std::size_t>(kSizes.size() * draw(2))];
    now_.kind = static_cast<Gesture::Kind>(1 + static_cast<int>(3 * draw(3)));
    now_.to_s = t_s + (0.7 + 1.5 * draw(4)) / std::max(size, 0.5);
    now_.size = draw(5) < 0.5 ? size : -size;
    if (Stopping(now_.size, position_rad)) now_.size = -now_.size;
  }

  Stream stream_;
  const Joint& joint_;
  Gesture now_;
  std::uint64_t count_ = 0;
};

/// Positions and rates of the joints, stepped by the chain of actuation.
class Plant {
 public:
  explicit Plant(const MachineModel& model)
      : model_(model),
        actuation_(model, {.machine = "null"}),
        levers_(Axes(), 0.0),
        motions_(Axes()) {
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      motions_[j].position_rad = model.joints[j].initial_rad;
    }
    Weigh();
  }

  void Step(std::size_t step) {
    if (step % kStepsPerSample == 0) Weigh();
    actuation_.Step(levers_, motions_, kPlantStep_s);
    for (std::size_t j = 0; j < model_.joints.size(); ++j) {
      const Joint& joint = model_.joints[j];
      AxisMotion& motion = motions_[j];
      double asked_radps = actuation_.drives()[j].rate_radps;
      if (inertia_kgm2_[j] > 0) {
        const double most = std::max(0.0, joint.max_effort_nm - motion.load_nm);
        const double least = std::max(0.0, joint.max_effort_nm + motion.load_nm);
        asked_radps =
            std::clamp(asked_radps, motion.rate_radps - least / inertia_kgm2_[j] * kPlantStep_s,
                       motion.rate_radps + most / inertia_kgm2_[j] * kPlantStep_s);
      }
      motion.rate_radps = asked_radps;
      motion.position_rad += kPlantStep_s * asked_radps;
    }
  }

  double& lever(std::size_t axis) { return levers_[axis]; }
  const std::vector<AxisMotion>& motions() const { return motions_; }

 private:
  std::size_t Axes() const { return model_.joints.size() + model_.gear_drives.size(); }
  void Weigh() {
    std::vector<double> q_rad;
    for (std::size_t j = 0; j < model_.joints.size(); ++j)
      q_rad.push_back(motions_[j].position_rad);
    const auto load_nm = GravityLoads_nm(model_, Pose::Identity(), q_rad);
    for (std::size_t j = 0; j < q_rad.size(); ++j) motions_[j].load_nm = load_nm[j];
    inertia_kgm2_ = JointInertias_kgm2(model_, q_rad);
  }

  const MachineModel& model_;
  Actuation actuation_;
  std::vector<double> levers_, inertia_kgm2_;
  std::vector<AxisMotion> motions_;
};

NoiseModel NoiseOf(const Stream& stream) {
  constexpr std::array kCoefficients = {0.0, 0.5, 0.8, 0.95};
  const double ar = kCoefficients[static_cast<std::size_t>(4 * stream.Uniform(0))];
  const double dof = 3 + 9 * stream.Uniform(1);
  const double rms_radps = (0.1 + 0.3 * stream.Uniform(2)) * kPi / 180;
  return {.ar = {ar}, .scale = rms_radps * std::sqrt((1 - ar * ar) * (dof - 2) / dof), .dof = dof};
}

/// Whether a sample is lost.
std::vector<bool> Lost(std::size_t samples, const Stream& stream) {
  std::vector<bool> lost(samples, false);
  for (std::size_t k = 0; k < samples; ++k) {
    if (stream.Uniform(k) > 0.02 / 5.5) continue;
    const auto length = 1 + static_cast<std::size_t>(10 * stream.Uniform(k, 1));
    std::fill(lost.begin() + static_cast<std::ptrdiff_t>(k),
              lost.begin() + static_cast<std::ptrdiff_t>(std::min(k + length, samples)), true);
  }
  return lost;
}

}  // namespace

MachineModel RaisedTb235() {
  MachineModel model = ShippedMachine("tb235");
  const std::array<std::pair<const char*, double>, 3> start_deg = {
      {{"boom", 48}, {"arm", -85}, {"bucket", -40}}};
  for (const auto& [joint, q_deg] : start_deg) {
    model.joints[static_cast<std::size_t>(model.JointIndex(joint))].initial_rad = q_deg * kPi / 180;
  }
  return model;
}

NullRecording SimulateNull(const MachineModel& model, double duration_s, std::uint64_t seed) {
  const Stream stream(seed, "null");
  const MachineModel real = OffNominal(model, Stream(seed, "null/nominal"));
  Plant plant(real);
  std::vector<Hand> hands;
  std::vector<std::size_t> axes;
  std::vector<std::vector<double>> noise;
  NullRecording out;
  const auto samples = static_cast<std::size_t>(duration_s / (kPlantStep_s * kStepsPerSample));
  for (const std::string& name : kJoints) {
    axes.push_back(static_cast<std::size_t>(real.JointIndex(name)));
    hands.emplace_back(Stream(seed, "null/hand/" + name), real.joints[axes.back()]);
    const Stream own(seed, "null/noise/" + name);
    noise.push_back(SimulateNoise(NoiseOf(own), samples, own));
    out.commands.columns.push_back(name);
    out.encoders.recording.axes.push_back({name});
  }
  const std::vector<bool> lost = Lost(samples, Stream(seed, "null/lost"));
  for (std::size_t step = 0; step < samples * kStepsPerSample; ++step) {
    const TimeNs t_ns = FromSeconds(static_cast<double>(step) * kPlantStep_s);
    if (step % kStepsPerCommand == 0) {
      out.commands.t_ns.push_back(t_ns);
      out.commands.rows.emplace_back();
      for (std::size_t a = 0; a < axes.size(); ++a) {
        plant.lever(axes[a]) = hands[a].At(ToSeconds(t_ns), plant.motions()[axes[a]].position_rad);
        out.commands.rows.back().push_back(plant.lever(axes[a]));
      }
    }
    const std::size_t k = step / kStepsPerSample;
    if (step % kStepsPerSample == 0 && !lost[k]) {
      EncoderSample sample{.t_ns = t_ns + FromSeconds(3e-4 * stream.Gaussian(k)) + 5000000};
      for (std::size_t a = 0; a < axes.size(); ++a) {
        const AxisMotion& motion = plant.motions()[axes[a]];
        constexpr double kResolution_rad = 0.02 * kPi / 180;
        sample.q_rad.push_back(kResolution_rad * std::round(motion.position_rad / kResolution_rad));
        sample.qd_radps.push_back(motion.rate_radps + noise[a][k]);
      }
      out.encoders.recording.samples.push_back(std::move(sample));
    }
    plant.Step(step);
  }
  // Encoders and commands are sampled 5 ms after the recording's zero.
  for (TimeNs& t_ns : out.commands.t_ns) t_ns += 5000000;
  return out;
}

NullOutcome DiagnoseNull(const MachineModel& model, double duration_s, std::uint64_t seed) {
  const NullRecording recording = SimulateNull(model, duration_s, seed);
  const AxisLog log = MakeAxisLog(model, recording.commands, {recording.encoders}, 0.01);
  std::vector<ReplayBlock> blocks;
  for (std::size_t m = 0; m < log.measured.size(); ++m) {
    if (auto block = MakeAxisBlock(model, log, m)) blocks.push_back(std::move(*block));
  }
  NullOutcome outcome;
  const SearchOptions options = WithTotalsOf({}, blocks);
  for (const DiagnosedBlock& diagnosed :
       DiagnoseBlocks(std::move(blocks), options, seed, [](const BlockProgress&) {})) {
    const BlockDiagnosis& diagnosis = diagnosed.diagnosis;
    ++outcome.blocks;
    outcome.judged += diagnosis.is_testable ? 1 : 0;
    for (const Finding& finding : diagnosis.findings) {
      outcome.alarms.push_back(fmt::format("{} {} {:.4g} (p {:.2g}, {:.2g})", diagnosed.block.name,
                                           finding.term.candidate->mechanism->id,
                                           finding.term.values.front(), finding.evidence.p,
                                           finding.held_out.p));
    }
    for (const Unexplained& left : diagnosis.unexplained) {
      outcome.alarms.push_back(fmt::format("{} unexplained (p {}, {:.2g} at {:.2g})",
                                           diagnosed.block.name, left.p.value_or(-1), left.rmse,
                                           left.noise));
    }
    for (const Finding& finding : diagnosis.unconfirmed) {
      outcome.unconfirmed.push_back(
          fmt::format("{} {}", diagnosed.block.name, finding.term.candidate->mechanism->id));
    }
  }
  return outcome;
}

}  // namespace tera
