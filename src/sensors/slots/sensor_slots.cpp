#include "sensors/slots/sensor_slots.h"

#include <algorithm>

#include "core/check.h"
#include "sensors/slots/true_mount.h"

namespace tera {
namespace {

/// Gives a sample the times that its sensor writes.
template <typename Sample>
void Restamp(const ReportClock::Times& times, Sample* sample) {
  sample->t_ns = times.t_ns;
  sample->t_available_ns += times.late_ns;
}

}  // namespace

ImuSlots::ImuSlots(const Effects& effects, std::uint64_t seed, const std::string& stream_name)
    : ideal_(effects.empty()),
      axis_signs_(AxisSigns(effects)),
      errors_(effects, seed, stream_name),
      filter_(effects),
      clock_(effects, seed, stream_name) {}

void ImuSlots::Apply(ImuSample* sample) {
  if (ideal_) return;
  const std::int64_t k = next_++;
  sample->w_WS_S_radps = axis_signs_.cwiseProduct(sample->w_WS_S_radps);
  sample->f_S_mps2 = axis_signs_.cwiseProduct(sample->f_S_mps2);
  errors_.Sense(sample);
  if (filter_.present()) {
    Eigen::VectorXd x(6);
    x << sample->w_WS_S_radps, sample->f_S_mps2;
    const Eigen::VectorXd& y = filter_.Next(sample->t_ns, x);
    sample->w_WS_S_radps = y.head<3>();
    sample->f_S_mps2 = y.tail<3>();
  }
  errors_.ReadOut(k, sample);
  Restamp(clock_.Next(k, sample->t_ns), sample);
}

GnssSlots::GnssSlots(const Effects& effects, std::uint64_t seed, const std::string& stream_name)
    : ideal_(effects.empty()),
      errors_(effects, seed, stream_name),
      filter_(effects),
      clock_(effects, seed, stream_name) {}

void GnssSlots::Apply(const RaisedBoom& boom, const SiteFrame& site, GnssSample* sample) {
  if (ideal_) return;
  const std::int64_t k = next_++;
  const Vec3 before_m = sample->enu_m;
  errors_.Sense(k, boom, sample);
  const bool filtered = filter_.present() && sample->fix != GnssFix::kNone;
  if (filtered) sample->enu_m = filter_.Next(sample->t_ns, sample->enu_m);
  errors_.ReadOut(k, sample);
  if (filtered || sample->enu_m != before_m) {
    const SiteFrame::Geodetic place = site.ToGeodetic(sample->enu_m);
    sample->lat_deg = place.lat_deg;
    sample->lon_deg = place.lon_deg;
    sample->alt_m = place.height_m;
  }
  Restamp(clock_.Next(k, sample->t_ns), sample);
}

EncoderSlots::EncoderSlots(const Effects& effects, const std::vector<Effects>& axis_effects,
                           const std::vector<bool>& linear, const std::vector<std::string>& axes,
                           std::uint64_t seed, const std::string& stream_name)
    : ideal_(effects.empty() && std::all_of(axis_effects.begin(), axis_effects.end(),
                                            [](const Effects& e) { return e.empty(); })),
      filter_(effects),
      clock_(effects, seed, stream_name) {
  TERA_CHECK(linear.size() == axes.size(), linear.size(), axes.size());
  TERA_CHECK(axis_effects.empty() || axis_effects.size() == axes.size(), axis_effects.size());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Effects own = axis_effects.empty() ? Effects{} : axis_effects[i];
    axes_.emplace_back(EffectsOfAxis(effects, own), linear[i], seed, stream_name + "/" + axes[i]);
  }
}

void EncoderSlots::Apply(EncoderSample* sample) {
  if (ideal_) return;
  const std::int64_t k = next_++;
  const auto n = static_cast<Eigen::Index>(axes_.size());
  TERA_CHECK(sample->q_rad.size() == axes_.size(), sample->q_rad.size());
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    axes_[i].Sense(sample->t_ns, &sample->q_rad[i], &sample->qd_radps[i]);
  }
  if (filter_.present()) {
    Eigen::Map<Eigen::VectorXd> q(sample->q_rad.data(), n), qd(sample->qd_radps.data(), n);
    Eigen::VectorXd x(2 * n);
    x << q, qd;
    const Eigen::VectorXd& y = filter_.Next(sample->t_ns, x);
    q = y.head(n);
    qd = y.tail(n);
  }
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    axes_[i].ReadOut(k, &sample->q_rad[i], &sample->qd_radps[i]);
  }
  Restamp(clock_.Next(k, sample->t_ns), sample);
}

FrameSlots::FrameSlots(const Effects& effects, std::uint64_t seed, const std::string& stream_name)
    : errors_(effects, seed, stream_name), clock_(effects, seed, stream_name) {}

ReportClock::Times FrameSlots::Stamp(std::int64_t k, TimeNs t_ns) { return clock_.Next(k, t_ns); }

void FrameSlots::Apply(std::int64_t k, const ReportClock::Times& times, LidarScan* scan) const {
  errors_.Apply(k, scan);
  for (LidarPoint& point : scan->points) {
    point.time_offset_ns = static_cast<std::uint32_t>(clock_.Duration(point.time_offset_ns));
  }
  Restamp(times, scan);
}

void FrameSlots::Apply(std::int64_t k, const ReportClock::Times& times, CameraFrame* frame) const {
  errors_.Apply(k, frame);
  Restamp(times, frame);
}

}  // namespace tera
