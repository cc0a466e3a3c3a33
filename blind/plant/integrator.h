#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace tera::blind {

/// Integrates x' = f(t, x) with kinks.
///
/// Model   backward differences of variable order and step, Newton's method with a dense Jacobian
///         by differences; steps end at the zeros of `edges`.
/// Source  Hindmarsh et al. 2005, "SUNDIALS: suite of nonlinear and differential/algebraic equation
///         solvers"; library CVODE.
class Integrator {
 public:
  using Derivative = std::function<void(double t, std::span<const double> x, std::span<double> dx)>;
  using Edges = std::function<void(double t, std::span<const double> x, std::span<double> edges)>;

  Integrator(std::vector<double> x, Derivative derivative, std::size_t edge_count, Edges edges);
  ~Integrator();

  /// Integrates to `t_s`, not earlier than the previous call. The derivative's parameters must be
  /// unchanged since then, except with a Restart in between.
  std::span<const double> To(double t_s);
  /// Call after a change of the derivative.
  void Restart();

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace tera::blind
