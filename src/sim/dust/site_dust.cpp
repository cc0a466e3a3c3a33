#include "sim/dust/site_dust.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace tera {
namespace {

constexpr double kEddyHeight_m = 2;  ///< height at which the wind carries the eddies
constexpr double kAlong = 2.4, kAcross = 1.9;

DustGrid GridOf(const Scenario& scenario, const Instant& start, const TerrainSurface& ground) {
  const DustModel& model = *scenario.environment.weather.dust;
  Vec2 middle_W_m = Vec2::Zero();
  for (const MachineState& machine : start.machines) {
    middle_W_m += machine.links.front().X_WB.translation().head<2>() /
                  static_cast<double>(start.machines.size());
  }
  DustGrid grid;
  grid.cell_m = model.cell_m;
  grid.nx = grid.ny = std::max(2, static_cast<int>(std::lround(model.extent_m / model.cell_m)));
  grid.nz = std::max(2, static_cast<int>(std::lround(model.height_m / model.cell_m)));
  grid.origin_W_m = middle_W_m - Vec2::Constant(0.5 * grid.nx * grid.cell_m);
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      const Vec2 at = grid.origin_W_m + grid.cell_m * Vec2(i + 0.5, j + 0.5);
      grid.base_m.push_back(ground.HeightAt(at.x(), at.y()));
    }
  }
  return grid;
}

DustVolume VolumeOf(const DustGrid& grid) {
  DustVolume volume;
  volume.origin_W_m = grid.origin_W_m;
  volume.cell_m = grid.cell_m;
  volume.nx = grid.nx;
  volume.ny = grid.ny;
  volume.nz = grid.nz;
  volume.base_m.assign(grid.base_m.begin(), grid.base_m.end());
  volume.extinction_1pm.assign(grid.index(0, 0, grid.nz), 0.0f);
  volume.eddies = std::make_shared<const DustEddies>();
  return volume;
}

/// Bounding box of the cells with dust, and of the pits below them.
Eigen::AlignedBox3d BoxOf(const DustGrid& grid, const DustField::Reach& reach) {
  constexpr double kPit_m = 5;
  Eigen::AlignedBox3d box;
  if (reach.is_empty()) return box;
  const auto [low, high] = std::minmax_element(grid.base_m.begin(), grid.base_m.end());
  const double half_m = 0.5 * grid.cell_m;
  const auto corner = [&](const std::array<int, 3>& cell, double base_m, double beyond_m) {
    const Vec2 xy =
        grid.origin_W_m + grid.cell_m * Vec2(cell[0], cell[1]) + Vec2::Constant(beyond_m);
    return Vec3(xy.x(), xy.y(), base_m + grid.cell_m * cell[2] + beyond_m);
  };
  box.extend(corner(reach.low, *low - (reach.low[2] == 0 ? kPit_m : 0), -half_m));
  box.extend(corner(reach.high, *high, half_m));
  return box;
}

}  // namespace

SiteDust::SiteDust(const Scenario& scenario, const Instant& start, const TerrainSurface& ground)
    : scenario_(scenario),
      sources_(scenario),
      field_(
          GridOf(scenario, start, ground),
          NeutralAir(
              scenario.environment.weather.wind,
              std::max(2, static_cast<int>(std::lround(scenario.environment.weather.dust->height_m /
                                                       scenario.environment.weather.dust->cell_m))),
              scenario.environment.weather.dust->cell_m)),
      gusts_(scenario.seed, "environment/gusts"),
      stepped_ns_(start.t_ns),
      volume_(VolumeOf(field_.grid())) {
  const Vec2 carried_mps =
      NeutralAir(scenario.environment.weather.wind, 1, 2 * kEddyHeight_m).wind_W_mps.front();
  eddies_mps_ = Vec3(carried_mps.x(), carried_mps.y(), 0);
}

Vec2 SiteDust::Gust(double dt_s) {
  const Wind& wind = scenario_.environment.weather.wind;
  const double friction_mps = FrictionVelocity_mps(wind.speed_mps);
  const double kept = std::exp(-dt_s / kGust_s), fresh = std::sqrt(1 - kept * kept);
  const Vec3 draw = gusts_.Gaussian3(steps_);
  gust_along_mps_ =
      kept * gust_along_mps_ + fresh * friction_mps * Vec2(kAlong * draw.x(), kAcross * draw.y());
  const Vec2 along_W = wind.towards_W(), across_W(-along_W.y(), along_W.x());
  return gust_along_mps_.x() * along_W + gust_along_mps_.y() * across_W;
}

void SiteDust::Step(const WorldStep& step) {
  sources_.AddWork(step, &puffs_);
  for (; step.after.t_ns >= stepped_ns_ + kStep_ns; stepped_ns_ += kStep_ns, ++steps_) {
    const double dt_s = ToSeconds(kStep_ns);
    sources_.AddFalls(step.ground, &puffs_);
    sources_.AddBlown(step.ground, dt_s, &puffs_);
    const double factor = scenario_.environment.weather.dust->emission_factor;
    for (DustPuff& puff : puffs_) {
      for (double& kg : puff.mass_kg) kg *= factor;
      field_.Emit(puff.centre_W_m, puff.radius_m, puff.mass_kg);
    }
    puffs_.clear();
    const Vec2 gust_W_mps = Gust(dt_s);
    field_.Advance(dt_s, gust_W_mps);
    volume_.drift_m += dt_s * (eddies_mps_ + Vec3(gust_W_mps.x(), gust_W_mps.y(), 0));
    is_current_ = false;
  }
}

const DustVolume& SiteDust::volume() const {
  if (is_current_) return volume_;
  const DustGrid& grid = field_.grid();
  const double cell_m3 = std::pow(grid.cell_m, 3);
  const DustField::Reach& reach = field_.reach();
  for (int k = reach.low[2]; k < reach.high[2]; ++k) {
    for (int j = reach.low[1]; j < reach.high[1]; ++j) {
      for (int i = reach.low[0]; i < reach.high[0]; ++i) {
        const std::size_t at = grid.index(i, j, k);
        double sum = 0;
        for (int size = 0; size < kDustSizes; ++size) {
          sum += Extinction_m2pkg(size) * field_.cells_kg(size)[at] / cell_m3;
        }
        volume_.extinction_1pm[at] = static_cast<float>(std::max(sum, 0.0));
      }
    }
  }
  volume_.occupied_W_m = BoxOf(grid, reach);
  ++volume_.version;
  is_current_ = true;
  return volume_;
}

}  // namespace tera
