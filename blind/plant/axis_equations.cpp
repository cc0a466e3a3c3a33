#include "blind/plant/axis_equations.h"

#include <algorithm>
#include <cmath>

namespace tera::blind {
namespace {

constexpr double kServo_s = 0.004;  ///< of the rate that a motor asks for
constexpr double kRampEdge = 0.02;  ///< share of the full rate over which a ramp rounds
constexpr double kGap_radps = 120;  ///< contact of two masses: its frequency
constexpr double kGapDamping = 0.6;
constexpr double kSeized_radps2 = 60;  ///< the second mass's friction by its inertia
constexpr double kStill_radps = 0.002;

/// Area of a round notch that opens over `notch` and goes on as a slot.
double Slot(double stroke, double notch) {
  if (stroke <= 0) return 0;
  return stroke < notch ? stroke * stroke / (2 * notch) : stroke - notch / 2;
}

}  // namespace

double Play_rad(const AxisForm& form) {
  return form.gap_rad + 2 * kSeized_radps2 / (kGap_radps * kGap_radps);
}

AxisEquations::AxisEquations(const Excavator& excavator, std::size_t axis, const AxisForm& form)
    : excavator_(excavator), axis_(axis), form_(form) {}

void AxisEquations::Start(const Surroundings& at, double q_rad, std::span<double> x) const {
  std::fill(x.begin(), x.end(), 0.0);
  double* own = x.data() + form_.line_stages;
  own[kDrive] = own[kAngle] = q_rad;
  if (form_.flex_radps > 0) {
    own[kDrive] += at.load_nm / (at.inertia_kgm2 * form_.flex_radps * form_.flex_radps);
  }
  if (form_.supply_nm > 0) own[kPressure] = at.load_nm / form_.supply_nm;
}

/// Share of the full rate that the valve gives at a lever.
double AxisEquations::Opening(double lever) const {
  double area = std::abs(lever);
  if (form_.overlap > 0) area = Slot(area - form_.overlap, form_.notch);
  if (form_.area_square != 0) area *= 1 - form_.area_square + form_.area_square * area;
  if (form_.area_end > 0) area /= std::pow(1 + std::pow(area / form_.area_end, 16), 1.0 / 16);
  const double flow = std::copysign(area, lever) * form_.delivered;
  return lever < 0 ? flow * form_.piston_ratio : flow;
}

/// The rate that the drive would give without the masses.
double AxisEquations::Wanted_radps(const Surroundings& at, std::span<const double> x,
                                   double q_rad) const {
  const double* own = x.data() + form_.line_stages;
  const double signal = form_.line_stages > 0 ? x[form_.line_stages - 1] : at.lever;
  double share = form_.lag_s > 0 ? own[kLag3] : Opening(signal);
  if (form_.slew_per_s > 0) share = own[kRamp];
  const PlainAxis& axis = excavator_.axis(axis_);
  double rate = share * (share < 0 ? axis.rate_negative_radps : axis.rate_positive_radps);
  rate *= 1 - form_.warm_share * std::exp(-at.t_s / form_.warm_s);
  rate *= 1 - form_.other_share * std::abs(at.other_lever);
  rate *= 1 + form_.ripple_share * std::sin(form_.ripple_cycles * q_rad);
  if (form_.pins) {
    rate *= excavator_.PinSlope_mprad(axis_, form_.pins_at_rad) /
            excavator_.PinSlope_mprad(axis_, WithinStops(q_rad));
  }
  return rate;
}

/// The same levers without another effect may lead beyond the stops, and there to the cylinder's
/// dead point: it stays as it is at the stop.
double AxisEquations::WithinStops(double q_rad) const {
  const PlainAxis& axis = excavator_.axis(axis_);
  return std::clamp(q_rad, axis.lower_rad, axis.upper_rad);
}

double AxisEquations::Asked_nm(const Surroundings& at, double wanted_radps, double w_radps) const {
  const double servo_s = form_.bristle_nm > 0 ? form_.weak_s : kServo_s;
  return at.load_nm + at.inertia_kgm2 * (wanted_radps - w_radps) / servo_s;
}

void AxisEquations::Derive(const Surroundings& at, std::span<const double> x,
                           std::span<double> dx) const {
  const std::size_t n = form_.line_stages;
  for (std::size_t i = 0; i < n; ++i) {
    const double before = i == 0 ? at.lever : x[i - 1];
    dx[i] = (before - x[i]) * static_cast<double>(n) / form_.line_s;
  }
  const double* own = x.data() + n;
  double* d = dx.data() + n;
  std::fill(d, d + kFixed, 0.0);
  const double signal = n > 0 ? x[n - 1] : at.lever;
  if (form_.lag_s > 0) {
    d[kLag1] = (Opening(signal) - own[kLag1]) / (form_.lag_s * kLagShares[0]);
    d[kLag2] = (own[kLag1] - own[kLag2]) / (form_.lag_s * kLagShares[1]);
    d[kLag3] = (own[kLag2] - own[kLag3]) / (form_.lag_s * kLagShares[2]);
  }
  if (form_.slew_per_s > 0) {
    const double share = form_.lag_s > 0 ? own[kLag3] : Opening(signal);
    d[kRamp] = form_.slew_per_s * std::tanh((share - own[kRamp]) / kRampEdge);
  }
  const double q = own[kAngle], w = own[kRate], I = at.inertia_kgm2;
  const double wanted = Wanted_radps(at, x, q);
  d[kAngle] = w;
  d[kDrive] = wanted;
  if (form_.supply_nm > 0) {
    // Oil between valve and piston: what flows in and is not made room for presses.
    const double pressed = std::clamp(own[kPressure], -0.999, 0.999);
    const double against = wanted < 0 ? -pressed : pressed;
    const double flow = wanted * std::sqrt(1 - against);
    const double spring = form_.oil_radps * form_.oil_radps * I;
    const double damper = 2 * form_.oil_damping * form_.oil_radps * I;
    d[kPressure] = spring / form_.supply_nm * (flow - w);
    d[kRate] = (form_.supply_nm * own[kPressure] + damper * (flow - w) - at.load_nm) / I;
  } else if (form_.flex_radps > 0) {
    const double spring = form_.flex_radps * form_.flex_radps;
    d[kRate] = spring * (own[kDrive] - q) +
               2 * form_.flex_damping * form_.flex_radps * (wanted - w) - at.load_nm / I;
  } else if (form_.gap_rad > 0) {
    const double apart = own[kDrive] - q, beyond = std::abs(apart) - form_.gap_rad / 2;
    double push = 0;
    if (beyond > 0) {
      push = kGap_radps * kGap_radps * std::copysign(beyond, apart) +
             2 * kGapDamping * kGap_radps * (wanted - w);
      push = apart > 0 ? std::max(0.0, push) : std::min(0.0, push);
    }
    d[kRate] = push - kSeized_radps2 * std::tanh(w / kStill_radps);
  } else {
    double friction = 0;
    if (form_.bristle_nm > 0) {
      // Bristles that bend until they slip.
      const double stiffness = form_.bristle_nm / 5e-4;
      const double slide = w / form_.bristle_radps;
      const double hold = form_.bristle_nm * (form_.sliding_share +
                                              (1 - form_.sliding_share) * std::exp(-slide * slide));
      d[kBristle] = w - stiffness * std::abs(w) / hold * own[kBristle];
      friction = stiffness * own[kBristle] + 0.02 * I * 2 * std::sqrt(stiffness / I) * d[kBristle];
    }
    const double most = excavator_.axis(axis_).effort_nm;
    d[kRate] = (std::clamp(Asked_nm(at, wanted, w), -most, most) - at.load_nm - friction) / I;
  }
}

void AxisEquations::Edges(const Surroundings& at, std::span<const double> x,
                          std::span<double> edges) const {
  const std::size_t n = form_.line_stages;
  const double* own = x.data() + n;
  const double signal = n > 0 ? x[n - 1] : at.lever;
  edges[0] = form_.overlap > 0 ? std::abs(signal) - form_.overlap : 1;
  edges[1] = form_.gap_rad > 0 ? std::abs(own[kDrive] - own[kAngle]) - form_.gap_rad / 2 : 1;
  const double wanted = Wanted_radps(at, x, own[kAngle]);
  const double asked = Asked_nm(at, wanted, own[kRate]);
  edges[2] = std::abs(asked) / excavator_.axis(axis_).effort_nm - 1;
  edges[3] = form_.bristle_nm > 0 ? own[kRate] : 1;
}

}  // namespace tera::blind
