#include "sensors/gnss/gnss_errors.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

Vec3 PerAxis(const Effects& effects, std::string_view id, std::string_view horizontal,
             std::string_view vertical) {
  return VectorOf(effects, id, horizontal, horizontal, vertical);
}

}  // namespace

Vec3 MultipathError(const Effects& effects, const RaisedBoom& boom) {
  const Effect* effect = FindEffect(effects, "multipath");
  if (!effect) return Vec3::Zero();
  const double raised = std::max(0.0, boom.direction_W.z());
  const double a_rad =
      std::atan2(boom.direction_W.y(), boom.direction_W.x()) - (*effect)["azimuth_deg"] * kDeg;
  const double h_m = (*effect)["horizontal_m"], v_m = (*effect)["vertical_m"];
  return raised * Vec3(h_m * std::cos(a_rad), h_m * std::sin(a_rad), v_m * std::cos(a_rad));
}

FloatJumps::FloatJumps(const Effects& effects, std::uint64_t seed, const std::string& stream_name)
    : stream_(seed, stream_name + "/float_jump") {
  const Effect* effect = FindEffect(effects, "float_jump");
  if (!effect) return;
  present_ = true;
  interval_s_ = (*effect)["interval_s"];
  duration_s_ = (*effect)["duration_s"];
  sigma_m_ = PerAxis(effects, "float_jump", "horizontal_m", "vertical_m");
}

void FloatJumps::Apply(std::int64_t k, GnssSample* sample) {
  if (!present_) return;
  const auto index = static_cast<std::uint64_t>(k);
  if (last_ns_) {
    const double mean_s = floating_ ? duration_s_ : interval_s_;
    const double change = -std::expm1(-ToSeconds(sample->t_ns - *last_ns_) / mean_s);
    if (stream_.Uniform(index) < change) {
      floating_ = !floating_;
      offset_m_ = sigma_m_.cwiseProduct(stream_.Gaussian3(index, 1));
    }
  }
  last_ns_ = sample->t_ns;
  // Only a fixed solution can fall back to a float solution.
  if (!floating_ || sample->fix != GnssFix::kRtkFixed) return;
  sample->enu_m += offset_m_;
  sample->variance_enu_m2 += sigma_m_.cwiseAbs2();
  sample->fix = GnssFix::kRtkFloat;
}

GnssErrors::GnssErrors(const Effects& effects, std::uint64_t seed, const std::string& stream_name)
    : effects_(effects),
      datum_m_(NumberOf(effects, "position_datum", "east_m", 0),
               NumberOf(effects, "position_datum", "north_m", 0),
               NumberOf(effects, "height_datum", "offset_m", 0)),
      outlier_m_(PerAxis(effects, "outliers", "horizontal_m", "vertical_m")),
      step_m_(PerAxis(effects, "quantisation", "horizontal_step_m", "vertical_step_m")),
      outliers_(effects, seed, stream_name),
      jumps_(effects, seed, stream_name) {}

void GnssErrors::Sense(std::int64_t k, const RaisedBoom& boom, GnssSample* sample) {
  if (sample->fix == GnssFix::kNone) return;
  sample->enu_m += MultipathError(effects_, boom) + datum_m_;
  jumps_.Apply(k, sample);
}

void GnssErrors::ReadOut(std::int64_t k, GnssSample* sample) const {
  if (sample->fix == GnssFix::kNone) return;
  const auto index = static_cast<std::uint64_t>(k);
  if (outliers_.At(index)) sample->enu_m += outlier_m_.cwiseProduct(outliers_.Gaussian3(index));
  for (int i = 0; i < 3; ++i) sample->enu_m[i] = Quantised(sample->enu_m[i], step_m_[i]);
}

}  // namespace tera
