#pragma once

#include <cstddef>
#include <span>

#include "blind/plant/axis_form.h"
#include "blind/plant/excavator.h"

namespace tera::blind {

/// State of the rest of the machine as one joint senses it, at an instant.
struct Surroundings {
  double t_s = 0, lever = 0, other_lever = 0;
  double load_nm = 0, inertia_kgm2 = 1;
};

/// Play of a drive with this gap at a reversal: the gap, and the deflection of the contact on the
/// seized pin on either side.
double Play_rad(const AxisForm& form);

/// The equations of one joint: state, derivative, edges.
///
/// Model   state: line lags, two lags, ramp, pressure, drive's angle, bristle, then rate and angle.
class AxisEquations {
 public:
  AxisEquations(const Excavator& excavator, std::size_t axis, const AxisForm& form);

  std::size_t size() const { return kFixed + form_.line_stages; }
  static constexpr std::size_t kEdges = 4;

  double angle(std::span<const double> x) const { return x[form_.line_stages + kAngle]; }
  double rate(std::span<const double> x) const { return x[form_.line_stages + kRate]; }
  /// Starts at rest, with every spring bent by the weight.
  void Start(const Surroundings& at, double q_rad, std::span<double> x) const;

  void Derive(const Surroundings& at, std::span<const double> x, std::span<double> dx) const;
  /// Functions that are zero where the equations have a kink.
  void Edges(const Surroundings& at, std::span<const double> x, std::span<double> edges) const;

 private:
  enum Place : std::size_t {
    kLag1,
    kLag2,
    kLag3,
    kRamp,
    kPressure,
    kDrive,
    kBristle,
    kRate,
    kAngle,
    kFixed
  };

  double Opening(double lever) const;
  double Wanted_radps(const Surroundings& at, std::span<const double> x, double q_rad) const;
  double WithinStops(double q_rad) const;
  /// A motor's demanded effort, within its limits.
  double Asked_nm(const Surroundings& at, double wanted_radps, double w_radps) const;

  const Excavator& excavator_;
  std::size_t axis_;
  AxisForm form_;
};

}  // namespace tera::blind
