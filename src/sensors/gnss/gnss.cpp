#include "sensors/gnss/gnss.h"

#include <array>
#include <cmath>
#include <utility>

#include "core/check.h"

namespace tera {
namespace {

constexpr std::array<std::pair<std::string_view, GnssFix>, 5> kFixNames = {{
    {"none", GnssFix::kNone},
    {"single", GnssFix::kSingle},
    {"differential", GnssFix::kDifferential},
    {"rtk_fixed", GnssFix::kRtkFixed},
    {"rtk_float", GnssFix::kRtkFloat},
}};

Vec3 PerAxis(double horizontal, double vertical) { return {horizontal, horizontal, vertical}; }

}  // namespace

std::string_view NameOf(GnssFix fix) {
  for (const auto& [name, value] : kFixNames) {
    if (value == fix) return name;
  }
  TERA_CHECK(false, static_cast<int>(fix));
  return {};
}

void Serialize(ModelArchive* archive, GnssModel* m) {
  const Range sigma_m = AtLeast(0, "m");
  archive->Visit("white_horizontal_m", &m->white_horizontal_m, sigma_m);
  archive->Visit("white_vertical_m", &m->white_vertical_m, sigma_m);
  archive->Visit("correlated_horizontal_m", &m->correlated_horizontal_m, sigma_m);
  archive->Visit("correlated_vertical_m", &m->correlated_vertical_m, sigma_m);
  archive->Visit("correlation_time_s", &m->correlation_time_s, Positive("s"));
  archive->Visit("bias_enu_m", &m->bias_enu_m, Any("m"));
  std::string fix(NameOf(m->fix));
  archive->Visit("fix", &fix, {"none", "single", "differential", "rtk_fixed", "rtk_float"});
  for (const auto& [name, value] : kFixNames) {
    if (name == fix) m->fix = value;
  }
}

Gnss::Gnss(const GnssModel& model, const SampleClock& clock, TimeNs latency_ns, std::uint64_t seed,
           const std::string& stream_name)
    : model_(model),
      clock_(clock),
      latency_ns_(latency_ns),
      white_(seed, stream_name + "/white"),
      correlated_(seed, stream_name + "/correlated") {}

GnssSample Gnss::Measure(std::int64_t k, const Vec3& p_WS_m, const SiteFrame& site) {
  TERA_CHECK(k == next_, k, next_);
  ++next_;
  const Vec3 white_m = PerAxis(model_.white_horizontal_m, model_.white_vertical_m);
  const Vec3 stationary_m = PerAxis(model_.correlated_horizontal_m, model_.correlated_vertical_m);
  const Vec3 draw = stationary_m.cwiseProduct(correlated_.Gaussian3(k));
  if (k == 0) {
    correlated_enu_m_ = draw;
  } else {
    const double T_s = ToSeconds(clock_.Due(k) - clock_.Due(k - 1));
    const double kept = std::exp(-T_s / model_.correlation_time_s);
    correlated_enu_m_ = kept * correlated_enu_m_ + std::sqrt(1.0 - kept * kept) * draw;
  }

  GnssSample sample;
  sample.t_ns = clock_.Due(k);
  sample.t_available_ns = sample.t_ns + latency_ns_;
  sample.fix = model_.fix;
  if (model_.fix == GnssFix::kNone) return sample;
  sample.enu_m =
      p_WS_m + model_.bias_enu_m + correlated_enu_m_ + white_m.cwiseProduct(white_.Gaussian3(k));
  const SiteFrame::Geodetic place = site.ToGeodetic(sample.enu_m);
  sample.lat_deg = place.lat_deg;
  sample.lon_deg = place.lon_deg;
  sample.alt_m = place.height_m;
  sample.variance_enu_m2 = white_m.cwiseAbs2() + stationary_m.cwiseAbs2();
  return sample;
}

}  // namespace tera
