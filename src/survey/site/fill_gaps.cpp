#include "survey/site/fill_gaps.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <array>
#include <limits>

#include "core/check.h"

namespace tera {
namespace {

constexpr float kUnfilled = std::numeric_limits<float>::quiet_NaN();
constexpr std::array<std::array<int, 2>, 4> kSides = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// Initial guess: the mean of the known cells in the smallest block of 2^n by 2^n cells that
/// contains any.
std::vector<float> Guess(int nx, int ny, const std::vector<float>& height_m) {
  bool all_known = true;
  for (const float z : height_m) all_known = all_known && IsKnown(z);
  if (all_known) return height_m;
  const int half_x = (nx + 1) / 2, half_y = (ny + 1) / 2;
  std::vector<float> sums(static_cast<std::size_t>(half_x) * half_y, 0.0F), counts = sums;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const float z = height_m[static_cast<std::size_t>(j) * nx + i];
      if (!IsKnown(z)) continue;
      const std::size_t half = static_cast<std::size_t>(j / 2) * half_x + i / 2;
      sums[half] += z;
      counts[half] += 1;
    }
  }
  for (std::size_t k = 0; k < sums.size(); ++k) {
    sums[k] = counts[k] > 0 ? sums[k] / counts[k] : kUnfilled;
  }
  const std::vector<float> coarse = Guess(half_x, half_y, sums);
  std::vector<float> guess = height_m;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      float& z = guess[static_cast<std::size_t>(j) * nx + i];
      if (!IsKnown(z)) z = coarse[static_cast<std::size_t>(j / 2) * half_x + i / 2];
    }
  }
  return guess;
}

}  // namespace

void FillGaps(const CellGrid& grid, std::vector<float>* height_m) {
  std::vector<int> unknown(grid.size(), -1);
  int unknowns = 0;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (!IsKnown((*height_m)[k])) unknown[k] = unknowns++;
  }
  if (unknowns == 0) return;
  TERA_CHECK(static_cast<std::size_t>(unknowns) < grid.size(), unknowns);
  const std::vector<float> guess = Guess(grid.nx, grid.ny, *height_m);
  // Heights are relative to the first cell, so that the tolerance applies to height differences.
  const double base_m = guess.front();
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns), start(unknowns);
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      const int row = unknown[grid.At(i, j)];
      if (row < 0) continue;
      start[row] = guess[grid.At(i, j)] - base_m;
      double neighbours = 0;
      for (const auto& [di, dj] : kSides) {
        if (!grid.Has(i + di, j + dj)) continue;
        ++neighbours;
        const std::size_t other = grid.At(i + di, j + dj);
        if (unknown[other] >= 0) {
          entries.emplace_back(row, unknown[other], -1.0);
        } else {
          right[row] += (*height_m)[other] - base_m;
        }
      }
      entries.emplace_back(row, row, neighbours);
    }
  }
  Eigen::SparseMatrix<double> laplace(unknowns, unknowns);
  laplace.setFromTriplets(entries.begin(), entries.end());
  constexpr double kTolerance = 1e-6;
  constexpr int kMostSteps = 2000;
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(kTolerance);
  solver.setMaxIterations(kMostSteps);
  solver.compute(laplace);
  const Eigen::VectorXd filled = solver.solveWithGuess(right, start);
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (unknown[k] >= 0) (*height_m)[k] = static_cast<float>(base_m + filled[unknown[k]]);
  }
}

}  // namespace tera
