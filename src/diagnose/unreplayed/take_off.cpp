#include "diagnose/unreplayed/take_off.h"

#include <cmath>
#include <utility>

#include "core/check.h"
#include "diagnose/search/block/block_diagnosis.h"
#include "diagnose/search/fit/free_member.h"
#include "diagnose/search/fit/likelihood.h"

namespace tera {
namespace {

constexpr double kOfAmount = 0.25;  ///< standard deviation of how much of it there is

double RmsOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x * x;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

void AddTo(const std::vector<std::vector<double>>& unreplayed,
           std::vector<std::vector<double>>* predicted) {
  for (std::size_t c = 0; c < unreplayed.size(); ++c) {
    for (std::size_t k = 0; k < std::min(unreplayed[c].size(), (*predicted)[c].size()); ++k) {
      (*predicted)[c][k] += unreplayed[c][k];
    }
  }
}

/// With `unreplayed` in all that the block predicts, and its amount among the nuisances; an empty
/// list leaves its channel as it is.
void Extend(std::vector<std::vector<double>> unreplayed, ReplayBlock* block) {
  for (std::size_t c = 0; c < unreplayed.size(); ++c) {
    if (unreplayed[c].empty()) continue;
    Eigen::MatrixXd& nominal = block->channels[c].nominal;
    const auto rows = static_cast<Eigen::Index>(unreplayed[c].size());
    nominal.conservativeResize(rows, nominal.cols() + 1);
    nominal.rightCols(1) =
        kOfAmount * Eigen::Map<const Eigen::VectorXd>(unreplayed[c].data(), rows);
  }
  block->replay = [replay = block->replay, unreplayed = std::move(unreplayed)](
                      const Structure& terms, std::size_t samples) {
    std::vector<std::vector<double>> predicted = replay(terms, samples);
    AddTo(unreplayed, &predicted);
    return predicted;
  };
}

/// Log-likelihood of TRAIN and SELECT, a number for each channel, where nothing is wrong.
std::vector<double> LogLikelihoods(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
                                   const std::vector<Manoeuvre>& manoeuvres) {
  Mask seen = MaskOf(manoeuvres, Part::kTrain, block.samples());
  const Mask select = MaskOf(manoeuvres, Part::kSelect, block.samples());
  for (std::size_t k = 0; k < seen.size(); ++k) seen[k] = seen[k] || select[k];
  const Likelihood likelihood(block, noise, seen);
  const Misfit misfit = likelihood.Judge(block.predict({}));
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

std::vector<TakenOff> TakeOff(const Unreplayed& unreplayed, const Stream& stream,
                              ReplayBlock* block) {
  TERA_CHECK(unreplayed.channels.size() == block->channels.size(), unreplayed.channels.size());
  const std::vector<Manoeuvre> manoeuvres = ManoeuvresOf(*block, stream);
  const std::vector<NoiseModel> noise = NoiseOfBlock(*block, manoeuvres);
  const std::vector<double> without = LogLikelihoods(*block, noise, manoeuvres);
  ReplayBlock extended = *block;
  Extend(unreplayed.channels, &extended);
  const std::vector<double> with = LogLikelihoods(extended, noise, manoeuvres);
  std::vector<TakenOff> taken;
  std::vector<std::vector<double>> kept = unreplayed.channels;
  for (std::size_t c = 0; c < kept.size(); ++c) {
    const Channel& channel = block->channels[c];
    taken.push_back({channel.name, channel.unit, true, RmsOf(kept[c]), with[c] - without[c]});
    if (!taken.back().is_taken()) kept[c].clear();
  }
  Extend(std::move(kept), block);
  return taken;
}

}  // namespace tera
