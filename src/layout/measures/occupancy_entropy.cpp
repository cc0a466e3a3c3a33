#include "layout/measures/occupancy_entropy.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "layout/sight/look.h"

namespace tera {
namespace {

/// Whether a part of another machine belongs to a vehicle; masts and similar parts do not.
bool IsPartOfVehicle(SemanticClass label) {
  return label == SemanticClass::kUndercarriage || label == SemanticClass::kUpperStructure ||
         label == SemanticClass::kBoom || label == SemanticClass::kArm ||
         label == SemanticClass::kBucket || label == SemanticClass::kBlade ||
         label == SemanticClass::kTrack;
}

bool IsOccupant(SemanticClass label) {
  return label == SemanticClass::kPerson || label == SemanticClass::kTruck ||
         label == SemanticClass::kVehicle || IsPartOfVehicle(label);
}

}  // namespace

double BinaryEntropy(double p) {
  if (p <= 0 || p >= 1) return 0;
  return -p * std::log(p) - (1 - p) * std::log(1 - p);
}

std::vector<Occupant> OccupantsAt(const Instant& now, const Scenario& scenario,
                                  const SceneAssembly& assembly, std::size_t machine) {
  const std::string own = scenario.machines[machine].placement.name + "/";
  const std::vector<Pose> X_WB = assembly.BodyPoses(now);
  std::vector<Occupant> occupants;
  for (const SceneInstance& instance : assembly.model().instances) {
    if (instance.body < 0 || instance.is_whole || !IsOccupant(instance.label) ||
        instance.name.starts_with(own)) {
      continue;
    }
    occupants.push_back({X_WB[instance.body], instance.box_min_B_m, instance.box_max_B_m});
  }
  return occupants;
}

OccupancyEntropy::OccupancyEntropy(double radius_m, double height_m, double voxel_m)
    : voxel_m_(voxel_m) {
  const int across = static_cast<int>(std::ceil(2 * radius_m / voxel_m));
  const int up = static_cast<int>(std::ceil(height_m / voxel_m));
  const double low_m = -0.5 * across * voxel_m;
  for (int i = 0; i < across; ++i) {
    for (int j = 0; j < across; ++j) {
      for (int k = 0; k < up; ++k) {
        voxels_H_m_.emplace_back(low_m + (i + 0.5) * voxel_m, low_m + (j + 0.5) * voxel_m,
                                 (k + 0.5) * voxel_m);
      }
    }
  }
  occupied_.resize(voxels_H_m_.size(), 0);
}

void OccupancyEntropy::Count(const std::vector<Occupant>& occupants,
                             const std::vector<Vec3>& voxels_W_m) {
  const Vec3 half_m = Vec3::Constant(0.5 * voxel_m_);
  std::vector<Pose> X_BW;
  for (const Occupant& occupant : occupants) X_BW.push_back(occupant.X_WB.inverse());
  for (std::size_t v = 0; v < voxels_W_m.size(); ++v) {
    bool is_occupied = false;
    for (std::size_t o = 0; o < occupants.size() && !is_occupied; ++o) {
      const Vec3 p_B_m = X_BW[o] * voxels_W_m[v];
      is_occupied = (p_B_m.array() >= (occupants[o].low_B_m - half_m).array()).all() &&
                    (p_B_m.array() <= (occupants[o].high_B_m + half_m).array()).all();
    }
    occupied_[v] += is_occupied;
  }
}

void OccupancyEntropy::Add(const Pose& X_WH, const std::vector<Occupant>& occupants,
                           const Layout& layout, double reflectance, const Sighting& sighting) {
  const std::size_t count = voxels_H_m_.size();
  std::vector<Vec3> p_W_m;
  for (const Vec3& p_H_m : voxels_H_m_) p_W_m.push_back(X_WH * p_H_m);
  Count(occupants, p_W_m);
  const std::vector<Target> targets = InTheAir(p_W_m);
  const Asked a_ray{.reflectance = reflectance,
                    .ranges = true,
                    .least_per_m2 = 1 / (voxel_m_ * voxel_m_),
                    .margin_m = 0.5 * voxel_m_};
  Covered covered{std::vector<bool>(count), std::vector<bool>(count)};
  for (const Viewer& viewer : layout.viewers) {
    const std::vector<Look> looks = LookFrom(viewer, targets, a_ray, sighting);
    for (std::size_t v = 0; v < count; ++v) {
      if (looks[v].sees) covered.in_sight[v] = true;
      if (looks[v].sees || looks[v].why == Unseen::kBlocked) covered.through[v] = true;
    }
  }
  covered_.push_back(std::move(covered));
}

std::vector<double> OccupancyEntropy::Prior() const {
  std::vector<double> prior;
  const double moments = std::max<double>(1, static_cast<double>(covered_.size()));
  for (const int count : occupied_) prior.push_back(count / moments);
  return prior;
}

std::vector<Figure> OccupancyEntropy::Figures() const {
  const std::vector<double> prior = Prior();
  Figure through{{Measure::kInformation}}, in_sight{{Measure::kInformationInSight}};
  for (const Covered& covered : covered_) {
    double through_nat = 0, in_sight_nat = 0;
    for (std::size_t v = 0; v < prior.size(); ++v) {
      const double nat = BinaryEntropy(prior[v]);
      if (covered.through[v]) through_nat += nat;
      if (covered.in_sight[v]) in_sight_nat += nat;
    }
    through.at.push_back(through_nat);
    in_sight.at.push_back(in_sight_nat);
  }
  return {through, in_sight};
}

}  // namespace tera
