#include "layout/measures/people.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/units.h"
#include "layout/measures/quarter.h"

namespace tera {
namespace {

constexpr double kStep_m = 1.0;
constexpr double kNear_m = 12.0;
constexpr double kSector_rad = 2 * kPi / PersonRange::kSectors;

}  // namespace

PersonRange::PersonRange(Posture posture, const PersonStudy& study, double reflectance)
    : posture_(std::move(posture)),
      study_(study),
      reflectance_(reflectance),
      patches_(PatchesOf(posture_)),
      probability_(posture_.name, study_.cluster_points, static_cast<int>(Distances_m().size())) {}

std::vector<double> PersonRange::Distances_m() const {
  std::vector<double> distances_m;
  for (double d_m = kStep_m; d_m <= study_.farthest_m; d_m += kStep_m) distances_m.push_back(d_m);
  return distances_m;
}

PersonRange::Had PersonRange::HadOf(const std::vector<PersonPlace>& places, const Layout& layout,
                                    const Sighting& sighting) const {
  std::vector<Pose> X_WP;
  for (const PersonPlace& place : places) X_WP.push_back(place.X_WP);
  Had had{std::vector<bool>(places.size(), false), std::vector<double>(places.size(), 0)};
  for (const Viewer& viewer : layout.viewers) {
    const std::vector<double> count =
        SamplesOnPersons(patches_, X_WP, viewer, reflectance_, sighting);
    const bool is_lidar = viewer.field.samples == ViewField::Samples::kPoints;
    const double needed = is_lidar ? study_.lidar_points : study_.camera_px;
    for (std::size_t p = 0; p < places.size(); ++p) {
      had.enough[p] = had.enough[p] || count[p] >= needed;
      if (is_lidar) had.points[p] += kBodyOfBox * count[p];
    }
  }
  return had;
}

void PersonRange::Add(const Pose& X_WH, const std::vector<double>& hull_m, const Layout& layout,
                      const Sighting& sighting, const TerrainSurface& ground) {
  const std::vector<PersonPlace> places =
      PlacesAroundHull(X_WH, hull_m, Distances_m(), sighting, ground);
  const Had had = HadOf(places, layout, sighting);
  AddRange(places, had.enough);
  probability_.Add(places, had.points);
}

void PersonRange::AddRange(const std::vector<PersonPlace>& places,
                           const std::vector<bool>& detected) {
  const std::vector<double> distances_m = Distances_m();
  std::vector<double> farthest_m(kSectors, 0);
  std::vector<bool> broken(kSectors, false);
  std::size_t near = 0, near_detected = 0;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const auto [sector, step, X_WP] = places[p];
    const double distance_m = distances_m[static_cast<std::size_t>(step)];
    if (distance_m <= kNear_m) {
      ++near;
      near_detected += detected[p];
    }
    if (!detected[p]) broken[sector] = true;
    if (!broken[sector]) farthest_m[sector] = distance_m;
  }
  for (int sector = 0; sector < kSectors; ++sector) {
    detected_m_[sector].push_back(farthest_m[sector]);
  }
  within_12m_.push_back(static_cast<double>(near_detected) / static_cast<double>(near));
  tried_.push_back(near);
}

std::vector<Figure> PersonRange::Figures() const {
  const std::string name = "person/" + posture_.name;
  std::vector<Figure> figures;
  for (const Quarter& quarter : kQuarters) {
    Figure figure{fmt::format("{}/detected_to_m_{}", name, quarter.name), "m", true, {}, {}};
    for (std::size_t m = 0; m < within_12m_.size(); ++m) {
      double least_m = study_.farthest_m;
      for (int sector = 0; sector < kSectors; ++sector) {
        if (quarter.Holds(sector * kSector_rad))
          least_m = std::min(least_m, detected_m_[sector][m]);
      }
      figure.at.push_back(least_m);
      figure.error.push_back(EvenSigma(kStep_m));  // somewhere between two tried distances
    }
    figures.push_back(std::move(figure));
  }
  Figure share{name + "/detected_within_12m", "", true, within_12m_, {}};
  for (std::size_t m = 0; m < within_12m_.size(); ++m) {
    share.error.push_back(ShareError(within_12m_[m], tried_[m]));
  }
  figures.push_back(std::move(share));
  for (Figure& figure : probability_.Figures()) figures.push_back(std::move(figure));
  return figures;
}

PolarCurve PersonRange::Curve() const {
  PolarCurve curve{.name = "person/" + posture_.name,
                   .title = fmt::format("Distance from the machine up to which a {} person is "
                                        "detected, in m",
                                        posture_.name),
                   .most = study_.farthest_m,
                   .mean = {},
                   .worst = {}};
  for (const std::vector<double>& at_m : detected_m_) {
    const double sum_m = std::accumulate(at_m.begin(), at_m.end(), 0.0);
    curve.mean.push_back(sum_m / static_cast<double>(at_m.size()));
    curve.worst.push_back(*std::min_element(at_m.begin(), at_m.end()));
  }
  return curve;
}

}  // namespace tera
