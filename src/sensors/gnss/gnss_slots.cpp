#include "sensors/gnss/gnss_slots.h"

#include "sensors/slots/report_clock.h"

namespace tera {

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

}  // namespace tera
