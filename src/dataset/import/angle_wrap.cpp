#include "dataset/import/angle_wrap.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// A sensor may show both ends of its range, such as 0 and 360, so values may exceed a turn by one
/// step.
constexpr double kMostOfTurn = 1.01;

double SpanOfAngles(const std::vector<double>& angle) {
  const auto [low, high] = std::minmax_element(angle.begin(), angle.end());
  return angle.empty() ? 0 : *high - *low;
}

double TurnsBetween(double from, double to, double turn) { return std::round((to - from) / turn); }

}  // namespace

std::vector<std::size_t> JumpsOf(const std::vector<double>& angle, double turn) {
  std::vector<std::size_t> rows;
  const auto is_unlike = [&](double step, std::size_t other) {
    if (other == 0 || other >= angle.size()) return true;
    const double beside = angle[other] - angle[other - 1];
    return std::abs(step - beside) > std::max(0.5 * turn, std::abs(beside));
  };
  for (std::size_t i = 1; i < angle.size(); ++i) {
    const double step = angle[i] - angle[i - 1];
    const bool is_far = std::abs(step) > 0.5 * turn;
    if (is_far && is_unlike(step, i - 1) && is_unlike(step, i + 1)) rows.push_back(i);
  }
  return rows;
}

bool BeginsAnew(const std::vector<double>& angle, double turn) {
  constexpr double kMostOfOthers = 2, kLeastOfTurn = 0.005;
  const std::vector<std::size_t> jumps = JumpsOf(angle, turn);
  if (jumps.empty() || SpanOfAngles(angle) > kMostOfTurn * turn) return false;
  double others = kLeastOfTurn * turn, largest = 0;
  for (std::size_t i = 1, next = 0; i < angle.size(); ++i) {
    const double step = angle[i] - angle[i - 1];
    if (next == jumps.size() || jumps[next] != i) {
      others = std::max(others, std::abs(step));
      continue;
    }
    ++next;
    largest = std::max(largest, std::abs(step - turn * TurnsBetween(angle[i - 1], angle[i], turn)));
  }
  return largest <= kMostOfOthers * others;
}

std::size_t Unwrap(double turn, std::vector<double>* angle) {
  std::size_t changes = 0;
  double turns = 0;
  for (std::size_t i = 1; i < angle->size(); ++i) {
    const double more = TurnsBetween((*angle)[i - 1], (*angle)[i] + turn * turns, turn);
    if (more != 0) ++changes;
    turns -= more;
    (*angle)[i] += turn * turns;
  }
  return changes;
}

}  // namespace tera
