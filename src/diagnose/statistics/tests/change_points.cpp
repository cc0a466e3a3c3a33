#include "diagnose/statistics/tests/change_points.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr double kCell_s = 0.2;             ///< length of a cell, over which scores are summed
constexpr std::size_t kShortest_cells = 2;  ///< shortest segment

/// Sums of both scores over one cell, in units of their standard deviation per sample.
struct Cell {
  double count = 0, location = 0, scale = 0;
};

/// Fisher information of location and scale of the unit Student-t: the variances of the scores.
double LocationVariance(double dof) { return (dof + 1) / (dof + 3); }
double ScaleVariance(double dof) { return 2 * dof / (dof + 3); }

std::vector<Cell> GatherCells(const Series& innovations, double dof, std::size_t length) {
  std::vector<Cell> cells((innovations.size() + length - 1) / length);
  for (std::size_t k = 0; k < innovations.size(); ++k) {
    if (!innovations.valid[k]) continue;
    const double e = innovations.value[k];
    const double weight = (dof + 1) / (dof + e * e);
    Cell& cell = cells[k / length];
    ++cell.count;
    cell.location += weight * e / std::sqrt(LocationVariance(dof));
    cell.scale += (weight * e * e - 1) / std::sqrt(ScaleVariance(dof));
  }
  return cells;
}

/// Standard deviation of a score per sample, from differences of neighbouring cells. At least 1,
/// and 1 with fewer than ten differences. Slightly correlated innovations must not look like
/// changes.
double Inflation(const std::vector<Cell>& cells, double Cell::*score) {
  std::vector<double> difference;
  const Cell* before = nullptr;
  for (const Cell& cell : cells) {
    if (cell.count == 0) continue;
    if (before != nullptr) {
      difference.push_back((cell.*score / cell.count - before->*score / before->count) /
                           std::sqrt(1 / cell.count + 1 / before->count));
    }
    before = &cell;
  }
  return difference.size() < 10 ? 1 : std::max(1.0, RobustScale(difference));
}

/// Cumulative sums that give the cost of any segment of cells.
class Costs {
 public:
  explicit Costs(const std::vector<Cell>& cells) : sum_(cells.size() + 1) {
    for (std::size_t k = 0; k < cells.size(); ++k) {
      sum_[k + 1] = {sum_[k].count + cells[k].count, sum_[k].location + cells[k].location,
                     sum_[k].scale + cells[k].scale};
    }
  }

  Cell Sum(std::size_t begin, std::size_t end) const {
    return {sum_[end].count - sum_[begin].count, sum_[end].location - sum_[begin].location,
            sum_[end].scale - sum_[begin].scale};
  }
  /// Sum of squares about the segment's means, up to a constant that no segmentation changes.
  double Of(std::size_t begin, std::size_t end) const {
    const Cell sum = Sum(begin, end);
    if (sum.count == 0) return 0;
    return -(sum.location * sum.location + sum.scale * sum.scale) / sum.count;
  }

 private:
  std::vector<Cell> sum_;
};

/// Ends of the segments with the smallest cost; the last end is `count`.
std::vector<std::size_t> BestSegmentation(const Costs& costs, std::size_t count, double penalty,
                                          std::size_t shortest) {
  std::vector<double> least(count + 1, INFINITY);
  std::vector<std::size_t> from(count + 1, 0), candidates{0};
  least[0] = -penalty;
  for (std::size_t end = std::min(shortest, count); end <= count; ++end) {
    for (const std::size_t begin : candidates) {
      const double cost = least[begin] + costs.Of(begin, end) + penalty;
      if (cost >= least[end]) continue;
      least[end] = cost;
      from[end] = begin;
    }
    std::erase_if(candidates, [&](std::size_t begin) {
      return least[begin] + costs.Of(begin, end) >= least[end] + penalty;
    });
    if (end + 1 >= 2 * shortest) candidates.push_back(end + 1 - shortest);
  }
  std::vector<std::size_t> ends;
  for (std::size_t end = count; end > 0; end = from[end]) ends.push_back(end);
  std::reverse(ends.begin(), ends.end());
  return ends;
}

}  // namespace

ChangePoints FindChangePoints(const Series& innovations, double dof,
                              const ChangePointOptions& options) {
  TERA_CHECK(dof > 0, dof);
  ChangePoints out;
  const auto length = std::max<std::size_t>(
      static_cast<std::size_t>(std::lround(kCell_s / innovations.period_s)), 1);
  std::vector<Cell> cells = GatherCells(innovations, dof, length);
  if (cells.empty()) return out;
  const double of_location = options.guarded ? Inflation(cells, &Cell::location) : 1;
  const double of_scale = options.guarded ? Inflation(cells, &Cell::scale) : 1;
  for (Cell& cell : cells) {
    cell.location /= of_location;
    cell.scale /= of_scale;
  }
  const Costs costs(cells);
  const double penalty = 2 * std::log(static_cast<double>(cells.size()) / options.alpha);
  std::size_t begin = 0;
  for (const std::size_t end : BestSegmentation(costs, cells.size(), penalty, kShortest_cells)) {
    const Cell sum = costs.Sum(begin, end);
    LevelSegment segment;
    segment.samples = {begin * length, std::min(end * length, innovations.size())};
    if (sum.count > 0) {
      segment.level = sum.location / sum.count * of_location * std::sqrt(LocationVariance(dof));
      segment.excess = sum.scale / sum.count * of_scale * std::sqrt(ScaleVariance(dof));
      const double louder = std::max(sum.scale, 0.0);
      segment.significance = (sum.location * sum.location + louder * louder) / sum.count;
      segment.mismatch = segment.significance > penalty;
    }
    out.segments.push_back(segment);
    begin = end;
  }
  for (const LevelSegment& segment : out.segments) {
    if (!segment.mismatch) continue;
    const bool joins = !out.mismatch.empty() && out.mismatch.back().end == segment.samples.begin;
    if (joins) {
      out.mismatch.back().end = segment.samples.end;
    } else {
      out.mismatch.push_back(segment.samples);
    }
  }
  return out;
}

}  // namespace tera
