#pragma once

#include <vector>

#include "diagnose/motion/motion_problem.h"

namespace tera {

/// Residuals of one noise channel in the order of their times; those of a segment follow each
/// other.
struct ChannelResiduals {
  std::vector<std::vector<double>> by_segment;
};

/// Degrees of freedom of the errors' distribution.
inline constexpr double kErrorDof = 5;

/// The weight of a residual in iteratively reweighted least squares under Student's t.
double ErrorWeight(double residual, double sigma);

/// Sets scale and inflation of each channel by its residuals.
///
/// Model   mean and scale by maximum likelihood under Student's t with `kErrorDof`, the scale at
///         least the data sheet's. The mean of the residuals is an error and no noise. Inflation 1
///         + 2 sum rho_k of weighted residuals about that mean, up to the first lag with an
///         autocorrelation below 0.05, at most a hundred.
/// Omits   the part of the errors that the motion itself took up.
/// Source  Lange, Little and Taylor 1989; Sokal 1989, "Monte Carlo methods in statistical
///         mechanics", on summing autocorrelations.
void EstimateNoise(const std::vector<ChannelResiduals>& residuals,
                   std::vector<NoiseChannel>* noise);

}  // namespace tera
