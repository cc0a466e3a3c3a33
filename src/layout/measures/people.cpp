#include "layout/measures/people.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kStep_m = 1.0;
constexpr double kNear_m = 12.0;
constexpr int kPatchesUp = 4, kPatchesAcross = 2;
constexpr double kSector_rad = 2 * kPi / PersonRange::kSectors;

struct Quarter {
  const char* name;
  double azimuth_rad;
};
constexpr std::array<Quarter, 4> kQuarters = {
    {{"ahead", 0}, {"left", 0.5 * kPi}, {"behind", kPi}, {"right", 1.5 * kPi}}};

bool IsIn(const Quarter& quarter, int sector) {
  const double off_rad = std::remainder(sector * kSector_rad - quarter.azimuth_rad, 2 * kPi);
  return std::abs(off_rad) <= 0.25 * kPi + 1e-9;
}

}  // namespace

PersonRange::PersonRange(Posture posture, const PersonStudy& study, double reflectance)
    : posture_(std::move(posture)), study_(study), reflectance_(reflectance) {
  const Vec3 half_m = 0.5 * posture_.size_m;
  // Her frame P stands on the ground below her middle. All sides but the one that she stands on.
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      if (axis == 2 && side < 0) continue;
      const int across = axis == 0 ? 1 : 0, up = axis == 2 ? 1 : 2;
      Vec3 normal = Vec3::Zero();
      normal[axis] = side;
      for (int i = 0; i < kPatchesAcross; ++i) {
        for (int j = 0; j < kPatchesUp; ++j) {
          Vec3 p_m = normal.cwiseProduct(half_m);
          p_m[across] = half_m[across] * (2 * (i + 0.5) / kPatchesAcross - 1);
          p_m[up] = half_m[up] * (2 * (j + 0.5) / kPatchesUp - 1);
          p_m.z() += half_m.z();
          const double side_m2 = 4 * half_m[across] * half_m[up];
          patches_.push_back({p_m, normal, side_m2 / (kPatchesAcross * kPatchesUp)});
        }
      }
    }
  }
}

std::vector<double> PersonRange::Distances_m() const {
  std::vector<double> distances_m;
  for (double d_m = kStep_m; d_m <= study_.farthest_m; d_m += kStep_m) distances_m.push_back(d_m);
  return distances_m;
}

std::vector<PersonRange::Place> PersonRange::PlacesAround(const Pose& X_WH,
                                                          const std::vector<double>& hull_m,
                                                          const TerrainSurface& ground) const {
  const std::vector<double> distances_m = Distances_m();
  std::vector<Place> places;
  for (int sector = 0; sector < kSectors; ++sector) {
    const Mat3 R_WP = X_WH.linear() * Mat3(Eigen::AngleAxisd(sector * kSector_rad, Vec3::UnitZ()));
    for (std::size_t step = 0; step < distances_m.size(); ++step) {
      const double radius_m = hull_m[sector] + distances_m[step];
      Vec3 p_W_m = X_WH.translation() + radius_m * R_WP.col(0);
      p_W_m.z() = ground.HeightAt(p_W_m.x(), p_W_m.y());
      places.push_back({sector, static_cast<int>(step), MakePose(p_W_m, R_WP)});
    }
  }
  return places;
}

std::vector<bool> PersonRange::AreDetected(const std::vector<Place>& places, const Viewer& viewer,
                                           const Sighting& sighting) const {
  struct Sample {
    std::size_t place;
    double count;
  };
  std::vector<Sample> samples;
  std::vector<Sighting::Line> lines;
  const Vec3 from_W_m = viewer.X_WS.translation();
  const Mat3 R_SW = viewer.X_WS.linear().transpose();
  for (std::size_t p = 0; p < places.size(); ++p) {
    for (const Patch& patch : patches_) {
      const Vec3 p_W_m = places[p].X_WP * patch.p_m;
      const Vec3 way_W_m = p_W_m - from_W_m;
      const double range_m = way_W_m.norm();
      const double cosine = -(places[p].X_WP.linear() * patch.normal).dot(way_W_m) / range_m;
      if (cosine <= 0 || range_m < viewer.field.min_range_m) continue;
      if (range_m > viewer.field.reach_m(reflectance_ * cosine)) continue;
      const double per_sr = viewer.field.per_steradian(R_SW * way_W_m / range_m);
      if (per_sr <= 0) continue;
      samples.push_back({p, per_sr * patch.area_m2 * cosine / (range_m * range_m)});
      lines.push_back({from_W_m, p_W_m});
    }
  }
  const std::vector<std::optional<Blocked>> blocked = sighting.Try(lines);
  std::vector<double> count(places.size(), 0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!blocked[i]) count[samples[i].place] += samples[i].count;
  }
  const bool is_lidar = viewer.field.samples == ViewField::Samples::kPoints;
  const double needed = is_lidar ? study_.lidar_points : study_.camera_px;
  std::vector<bool> detected(places.size());
  for (std::size_t p = 0; p < places.size(); ++p) detected[p] = count[p] >= needed;
  return detected;
}

void PersonRange::Add(const Pose& X_WH, const std::vector<double>& hull_m, const Layout& layout,
                      const Sighting& sighting, const TerrainSurface& ground) {
  const std::vector<Place> places = PlacesAround(X_WH, hull_m, ground);
  std::vector<bool> detected(places.size(), false);
  for (const Viewer& viewer : layout.viewers) {
    const std::vector<bool> by = AreDetected(places, viewer, sighting);
    for (std::size_t p = 0; p < places.size(); ++p) detected[p] = detected[p] || by[p];
  }
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
        if (IsIn(quarter, sector)) least_m = std::min(least_m, detected_m_[sector][m]);
      }
      figure.at.push_back(least_m);
      figure.error.push_back(kStep_m / std::sqrt(12.0));  // somewhere between two tried distances
    }
    figures.push_back(std::move(figure));
  }
  Figure share{name + "/detected_within_12m", "", true, within_12m_, {}};
  for (std::size_t m = 0; m < within_12m_.size(); ++m) {
    share.error.push_back(ShareError(within_12m_[m], tried_[m]));
  }
  figures.push_back(std::move(share));
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
