#include "diagnose/discrepancy/discrepancy_correction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "diagnose/search/block/block_diagnosis.h"
#include "diagnose/search/fit/flexible_regressor.h"
#include "diagnose/search/fit/likelihood.h"
#include "physics/actuation/axes.h"

namespace tera {

std::vector<NamedEncoders> AsSimulated(const MachineModel& model, const SimulatedCourse& course,
                                       std::vector<NamedEncoders> measured) {
  for (NamedEncoders& named : measured) {
    EncoderRecording& recording = named.recording;
    std::erase_if(recording.samples,
                  [&](const EncoderSample& sample) { return sample.t_ns > course.end_ns(); });
    for (std::size_t i = 0; i < recording.axes.size(); ++i) {
      const int axis = AxisNamed(model, recording.axes[i].name);
      if (axis < 0) continue;
      for (EncoderSample& sample : recording.samples) {
        sample.q_rad[i] = course.PositionAt(sample.t_ns, static_cast<std::size_t>(axis));
        sample.qd_radps[i] = course.RateAt(sample.t_ns, static_cast<std::size_t>(axis));
      }
    }
  }
  return measured;
}

std::vector<TruthPose> AsSimulated(const SimulatedCourse& course,
                                   const std::vector<TruthPose>& measured) {
  std::vector<TruthPose> poses;
  for (const TruthPose& one : measured) {
    if (one.t_ns < course.zero_ns || one.t_ns > course.end_ns()) continue;
    TruthPose pose;
    pose.t_ns = one.t_ns;
    pose.X_WB = course.PoseAt(one.t_ns);
    poses.push_back(pose);
  }
  return poses;
}

namespace {

/// Standard deviation of the discrepancy's scale about 1. A scale between 0.5 and 1.5 is no
/// finding.
constexpr double kScaleSigma = 0.25;

double RmsOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x * x;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

void AddTo(const std::vector<std::vector<double>>& discrepancy,
           std::vector<std::vector<double>>* predicted) {
  for (std::size_t c = 0; c < discrepancy.size(); ++c) {
    for (std::size_t k = 0; k < std::min(discrepancy[c].size(), (*predicted)[c].size()); ++k) {
      (*predicted)[c][k] += discrepancy[c][k];
    }
  }
}

/// Adds `discrepancy` to the block's predictions, and its scale to the nuisances. A channel with an
/// empty list is unchanged.
void Extend(std::vector<std::vector<double>> discrepancy, ReplayBlock* block) {
  for (std::size_t c = 0; c < discrepancy.size(); ++c) {
    if (discrepancy[c].empty()) continue;
    Eigen::MatrixXd& nominal = block->channels[c].nominal;
    const auto rows = static_cast<Eigen::Index>(discrepancy[c].size());
    nominal.conservativeResize(rows, nominal.cols() + 1);
    nominal.rightCols(1) =
        kScaleSigma * Eigen::Map<const Eigen::VectorXd>(discrepancy[c].data(), rows);
  }
  block->replay = [replay = block->replay, discrepancy = std::move(discrepancy)](
                      const Structure& terms, std::size_t samples) {
    std::vector<std::vector<double>> predicted = replay(terms, samples);
    AddTo(discrepancy, &predicted);
    return predicted;
  };
}

/// Log-likelihood of TRAIN and SELECT without any term, by channel.
std::vector<double> LogLikelihoods(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
                                   const std::vector<Manoeuvre>& manoeuvres) {
  Mask seen = MaskOf(manoeuvres, Part::kTrain, block.samples());
  const Mask select = MaskOf(manoeuvres, Part::kSelect, block.samples());
  for (std::size_t k = 0; k < seen.size(); ++k) seen[k] = seen[k] || select[k];
  const Likelihood likelihood(block, noise, seen);
  const Misfit misfit = likelihood.Evaluate(block.predict({}));
  std::vector<double> sums;
  for (std::size_t c = 0; c < block.channels.size(); ++c) {
    double sum = -0.5 * misfit.nuisances[c].squaredNorm();
    for (const Segment& run : SegmentsOf(Both(seen, likelihood.rows(c)), 1)) {
      sum += likelihood.Sum(misfit, run, c);
    }
    sums.push_back(sum);
  }
  return sums;
}

}  // namespace

std::vector<DiscrepancyCorrection> CorrectDiscrepancy(const ReplayDiscrepancy& discrepancy,
                                                      const Stream& stream, ReplayBlock* block) {
  TERA_CHECK(discrepancy.channels.size() == block->channels.size(), discrepancy.channels.size());
  const std::vector<Manoeuvre> manoeuvres = ManoeuvresOf(*block, stream);
  const std::vector<NoiseModel> noise = NoiseOfBlock(*block, manoeuvres);
  const std::vector<double> without = LogLikelihoods(*block, noise, manoeuvres);
  ReplayBlock extended = *block;
  Extend(discrepancy.channels, &extended);
  const std::vector<double> with = LogLikelihoods(extended, noise, manoeuvres);
  std::vector<DiscrepancyCorrection> corrections;
  std::vector<std::vector<double>> applied = discrepancy.channels;
  for (std::size_t c = 0; c < applied.size(); ++c) {
    const Channel& channel = block->channels[c];
    corrections.push_back(
        {channel.name, channel.unit, true, RmsOf(applied[c]), with[c] - without[c]});
    if (!corrections.back().is_applied()) applied[c].clear();
  }
  Extend(std::move(applied), block);
  return corrections;
}

}  // namespace tera
