#include "layout/measures/sky_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/units.h"
#include "layout/study/zone.h"

namespace tera {
namespace {

constexpr double kFarthest_m = 300;  ///< objects beyond this range are ignored
constexpr double kSkySector_rad = 2 * kPi / SkyGrid::kSectors;

/// Sine of the lowest and the highest elevation of the part of a ring above the mask.
struct Band {
  double low = 0, high = 0;
};
Band BandOf(int ring, double mask_deg) {
  const double high_deg = 90 - ring * SkyGrid::kRing_deg;
  const double low_deg = std::max(high_deg - SkyGrid::kRing_deg, mask_deg);
  return {std::sin(low_deg * kDeg), std::sin(high_deg * kDeg)};
}

bool IsAny(SemanticClass) { return true; }

}  // namespace

SkyView::SkyView(const MachineModel& model, std::size_t machine,
                 const std::vector<SensorDescription>& sensors, double mask_deg)
    : machine_(machine) {
  const Stream within(0, "layout/sky");
  const double sky = 1 - std::sin(mask_deg * kDeg);
  for (int sector = 0; sector < SkyGrid::kSectors; ++sector) {
    for (int ring = 0; ring < SkyGrid::kRings; ++ring) {
      const Band band = BandOf(ring, mask_deg);
      if (band.high <= band.low) continue;
      const std::size_t cell = SkyGrid::Index(sector, ring);
      const double sine = band.low + within.Uniform(cell, 0) * (band.high - band.low);
      const double azimuth_rad = (sector - 0.5 + within.Uniform(cell, 1)) * kSkySector_rad;
      const double level = std::sqrt(1 - sine * sine);
      sky_.push_back({cell,
                      {level * std::cos(azimuth_rad), level * std::sin(azimuth_rad), sine},
                      (band.high - band.low) / (SkyGrid::kSectors * sky)});
    }
  }
  for (const SensorDescription& sensor : sensors) {
    if (!std::holds_alternative<GnssModel>(sensor.model)) continue;
    const Mounting mounting = TrueMounting(sensor, sensors);
    antennas_.push_back({sensor.name, model.LinkIndex(mounting.link), mounting.X_BT.translation()});
    antennas_.back().hidden_moments.assign(SkyGrid::kSectors * SkyGrid::kRings, 0);
  }
}

void SkyView::Add(const MachineState& machine, const Sighting& sighting) {
  const std::vector<bool> is_own = sighting.InstancesOf(machine_, IsAny);
  for (Antenna& antenna : antennas_) {
    const Pose& X_WB = machine.links[antenna.link].X_WB;
    const Vec3 p_WS_m = X_WB * antenna.p_BS_m;
    const Mat3 R_WA = Levelled(X_WB).linear();
    std::vector<Sighting::Line> lines;
    for (const Direction& direction : sky_) {
      lines.push_back({p_WS_m, p_WS_m + kFarthest_m * (R_WA * direction.d_A)});
    }
    const std::vector<std::optional<Blocked>> blocked = sighting.Try(lines);
    double by_machine = 0, by_site = 0;
    for (std::size_t i = 0; i < sky_.size(); ++i) {
      if (!blocked[i]) continue;
      const bool own = is_own[blocked[i]->instance];
      (own ? by_machine : by_site) += sky_[i].share;
      antenna.hidden_moments[sky_[i].cell] += own;
    }
    antenna.by_machine.push_back(by_machine);
    antenna.by_site.push_back(by_site);
  }
}

std::vector<Figure> SkyView::Figures() const {
  // The directions represent unequal parts of the sky. Stratified directions, one per cell, have a
  // smaller error than as many random ones.
  std::vector<double> shares;
  for (const Direction& direction : sky_) shares.push_back(direction.share);
  const double like = LikeCount(shares);
  std::vector<Figure> figures;
  const auto append = [&](FigureId id, const std::vector<double>& share) {
    Figure figure{std::move(id), share, {}};
    for (const double s : share) figure.error.push_back(ShareError(s, like));
    figures.push_back(std::move(figure));
  };
  for (const Antenna& antenna : antennas_) {
    append({Measure::kSkyHidden, antenna.name}, antenna.by_machine);
    append({Measure::kSkyHiddenBySite, antenna.name}, antenna.by_site);
  }
  return figures;
}

std::vector<PolarMap> SkyView::Maps() const {
  std::vector<PolarMap> maps;
  for (const Antenna& antenna : antennas_) {
    PolarMap map{.id = {Measure::kSkyHidden, antenna.name},
                 .title = fmt::format("Share of the cycle in which the machine hides the sky from "
                                      "{}; rings of {} degrees from the zenith",
                                      antenna.name, SkyGrid::kRing_deg),
                 .sectors = SkyGrid::kSectors,
                 .rings = SkyGrid::kRings,
                 .ring_m = SkyGrid::kRing_deg,
                 .ring_unit = "deg",
                 .low = 1,
                 .high = 0};
    map.value.assign(antenna.hidden_moments.size(), -1);
    const double moments = static_cast<double>(antenna.by_machine.size());
    for (const Direction& direction : sky_) {
      map.value[direction.cell] = antenna.hidden_moments[direction.cell] / moments;
    }
    maps.push_back(std::move(map));
  }
  return maps;
}

}  // namespace tera
