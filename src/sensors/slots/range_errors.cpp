#include "sensors/slots/range_errors.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// Bits for the index of a point or pixel within one measurement.
constexpr int kIndexBits = 32;

std::uint64_t FirstIndex(std::int64_t k) { return static_cast<std::uint64_t>(k) << kIndexBits; }

/// Parameter of mechanism `id`: `depth` for kinds that measure along an axis (cameras), else
/// `range`.
double Either(const Effects& effects, std::string_view id, std::string_view range,
              std::string_view depth, double ideal) {
  const Effect* effect = FindEffect(effects, id);
  if (!effect) return ideal;
  const std::vector<EffectParameter>& parameters = effect->mechanism->parameters;
  const bool is_depth = std::any_of(parameters.begin(), parameters.end(),
                                    [&](const EffectParameter& p) { return p.name == depth; });
  return (*effect)[is_depth ? depth : range];
}

}  // namespace

RangeScaling RangeScalingOf(const Effects& effects) {
  return {Either(effects, "scale", "range_factor", "depth_factor", 1),
          Either(effects, "range_bias", "range_m", "depth_m", 0)};
}

RangeErrors::RangeErrors(const Effects& effects, std::uint64_t seed, const std::string& stream_name)
    : present_(
          std::any_of(effects.begin(), effects.end(),
                      [](const Effect& e) { return e.mechanism->slot == Slot::kSensorStatic; })),
      scaling_(RangeScalingOf(effects)),
      drift_mpk_(NumberOf(effects, "temperature_drift", "range_mpk", 0)),
      outlier_m_(Either(effects, "outliers", "range_m", "depth_m", 0)),
      step_m_(Either(effects, "quantisation", "range_step_m", "depth_step_m", 0)),
      warm_up_(WarmUp::Of(effects)),
      outliers_(effects, seed, stream_name) {}

double RangeErrors::Report(double r_m, double warmer_k, std::uint64_t index) const {
  double reported_m = scaling_.factor * r_m + scaling_.bias_m + warmer_k * drift_mpk_;
  if (outliers_.At(index)) reported_m += outlier_m_ * outliers_.Gaussian(index);
  return std::max(0.0, Quantised(reported_m, step_m_));
}

void RangeErrors::Apply(std::int64_t k, LidarScan* scan) const {
  if (!present_) return;
  const double warmer_k = warm_up_.At(scan->t_ns);
  std::uint64_t index = FirstIndex(k);
  for (LidarPoint& p : scan->points) {
    const Eigen::Vector3d p_S_m(p.x_m, p.y_m, p.z_m);
    const double r_m = p_S_m.norm();
    const Eigen::Vector3f reported = (Report(r_m, warmer_k, index++) / r_m * p_S_m).cast<float>();
    p.x_m = reported.x();
    p.y_m = reported.y();
    p.z_m = reported.z();
  }
  std::erase_if(scan->points,
                [](const LidarPoint& p) { return p.x_m == 0 && p.y_m == 0 && p.z_m == 0; });
}

void RangeErrors::Apply(std::int64_t k, CameraFrame* frame) const {
  if (!present_) return;
  std::uint64_t index = FirstIndex(k);
  for (float& z_m : frame->depth_m.data) {
    if (z_m > 0) z_m = static_cast<float>(Report(z_m, warm_up_.At(frame->t_ns), index));
    ++index;
  }
}

}  // namespace tera
