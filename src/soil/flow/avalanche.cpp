#include "soil/flow/avalanche.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kStart_rad = 1.1 * kDeg;  ///< start angle above the angle of repose
constexpr double kSlow_rad = 0.9 * kDeg;  ///< friction angle of slow flow above the angle of repose
/// Range of Froude numbers, v / sqrt(g h), over which friction changes from slow to fast.
constexpr double kSlowFroude = 0.1, kFastFroude = 0.5;
/// Range of flowing over loose thickness with the same change, from a thin skin to the full depth.
constexpr double kSkinShare = 0.3, kDeepShare = 0.6;
/// Increase of friction per inertial number where that is small: (mu_2 - mu_s) / I_0 = (0.643 -
/// 0.382) / 0.279 for the beads of Jop, Forterre and Pouliquen.
constexpr double kInertialFriction = 0.93;
constexpr double kBagnold = 2.5;        ///< shear rate at the bed over mean speed by thickness
constexpr double kCreep_mps = 0.005;    ///< slower flow stops on slopes below the start angle
constexpr double kTrickle_m2ps = 2e-5;  ///< smaller flow stops there too, per metre of width
constexpr double kStep_s = 0.008;       ///< longer than the step of the tools, because flow is slow
/// banks under running gear are checked every 12 steps, about 0.1 s
constexpr int kStepsPerLoad = 12;
constexpr double kLongestStep_cells = 0.5;  ///< greatest displacement in a step
/// A column below this share of the start slope, to all sides, does not start to flow.
constexpr double kGentle = 0.65;
constexpr double kLevel = 1e-9;   ///< least gradient, against division by zero
constexpr double kFilm_m = 1e-4;  ///< the thinnest layer that flows
/// flowing thickness over the thickness above the slope of slow friction
constexpr double kMobileOverExcess = 20;
constexpr double kLeastUp = 0.05;  ///< least cosine between vertical and a normal

/// Length of a vector. Faster than std::hypot, for values that neither overflow nor underflow.
double Norm(double x, double y) { return std::sqrt(x * x + y * y); }

/// Rises linearly from 0 at `low` to 1 at `high`.
double Ramp(double x, double low, double high) {
  return std::clamp((x - low) / (high - low), 0.0, 1.0);
}

}  // namespace

Avalanche::Avalanche(const std::vector<SoilType>& soils) : walls_(soils) {
  for (const SoilType& soil : soils) {
    const double repose_rad = soil.repose_angle_rad;
    friction_.push_back({std::tan(repose_rad + kStart_rad), std::tan(repose_rad + kSlow_rad),
                         soil.fast_flow_friction, soil.grain_size_m});
    const double on_steel = std::tan(soil.soil_tool_friction_rad);
    steel_.push_back({on_steel, on_steel, 1, 0});
    thrust_.push_back((1 - std::sin(repose_rad)) / (1 + std::sin(repose_rad)));
  }
}

void Avalanche::StandOnSteel(const Vec3& up, bool is_open, Columns* ground) {
  is_open_ = is_open;
  tilt_ = up.head<2>() / std::max(up.z(), kLeastUp);
  is_tilted_ = !tilt_.isZero();
  normal_mps2_ = kStandardGravity_mps2 * std::max(up.z(), kLeastUp);
  for (int j = 0; j < ground->ny(); ++j) {
    for (int i = 0; i < ground->nx(); ++i) active_.Add(ground->Touch(i, j));
  }
}

/// Activates the column and its neighbours.
void Avalanche::Wake(ColumnId k, Columns* ground) {
  if (ground->IsWithinTile(k)) return active_.AddWithNeighbours(k);
  for (int dj = -1; dj <= 1; ++dj) {
    for (int di = -1; di <= 1; ++di) {
      ColumnId m = ground->BesideId(k, di, dj);
      if (m == Columns::kNone) {
        const auto [i, j] = ground->PlaceOf(k);
        if (!ground->Contains(i + di, j + dj)) continue;
        m = ground->Touch(i + di, j + dj);
      }
      active_.Add(m);
    }
  }
}

double Avalanche::VelocityOf(ColumnId k, int di, int dj, Axis axis, const Columns& ground) const {
  const ColumnId m = ground.BesideId(k, di, dj);
  return m == Columns::kNone || m >= motion_.size() ? 0.0 : motion_[m].face_mps[axis];
}

/// True if soil crosses any face of the column.
bool Avalanche::Flows(ColumnId k, const Columns& ground) const {
  return motion_[k].face_mps[kX] != 0 || motion_[k].face_mps[kY] != 0 ||
         VelocityOf(k, -1, 0, kX, ground) != 0 || VelocityOf(k, 0, -1, kY, ground) != 0;
}

/// Computes the slopes of a column, and whether it rests.
void Avalanche::LookAround(ColumnId k, const Columns& ground) {
  const Columns::Skin& c = ground.skin(k);
  const bool is_within = ground.IsWithinTile(k);
  double steepest_m = 0;
  std::uint8_t soil = c.soil;
  /// Height difference to a neighbour, limited to the loose soil of the higher column.
  const auto loose_rise_m = [&](int di, int dj) {
    const Columns::Skin* beside = is_within ? &c + Columns::Step(di, dj) : ground.Beside(k, di, dj);
    if (beside == nullptr) return 0.0;
    const double rise_m = beside->top_m - c.top_m;
    if (rise_m > steepest_m && beside->is_loose) soil = beside->soil;
    steepest_m = std::max(steepest_m, std::abs(rise_m));
    return rise_m > 0 ? std::min(rise_m, beside->loose_m) : std::max(rise_m, -c.loose_m);
  };
  Motion& motion = motion_[k];
  const double along_x_m = loose_rise_m(1, 0) - loose_rise_m(-1, 0);
  const double along_y_m = loose_rise_m(0, 1) - loose_rise_m(0, -1);
  motion.across_slope[kX] = 0.5 * along_y_m / ground.cell_m();
  motion.across_slope[kY] = 0.5 * along_x_m / ground.cell_m();
  motion.rests = !is_tilted_ &&
                 steepest_m <= kGentle * friction_[soil].tan_start * ground.cell_m() &&
                 !Flows(k, ground);
}

/// Speed after friction. The soil flows `flow_m` thick in the loose depth `loose_m`, under gravity
/// normal to its bed. If friction rises with speed, it is evaluated at the final speed, so that a
/// step cannot overshoot.
double Avalanche::Friction::Braked(double before_mps, double speed_mps, const Layer& layer,
                                   double gravity_mps2, double dt_s) const {
  const double froude = before_mps / std::sqrt(gravity_mps2 * layer.flow_m);
  const double fast =
      Ramp(froude, kSlowFroude, kFastFroude) *
      Ramp(layer.flow_m / std::max(layer.loose_m, layer.flow_m), kSkinShare, kDeepShare);
  const double inertial_number = kBagnold * froude * grain_m / layer.flow_m;
  const double rise = tan_slow * fast * (fast_over_slow - 1) + kInertialFriction * inertial_number;
  const double slow_mps = tan_slow * gravity_mps2 * dt_s;
  const double rise_mps = rise * gravity_mps2 * dt_s;
  return rise_mps > 0 ? (speed_mps - slow_mps) / (1 + rise_mps / speed_mps)
                      : speed_mps - slow_mps - rise_mps;
}

/// Turns the drive at a face on a level floor into that on the tilted floor.
Avalanche::Drive Avalanche::OnFloor(const Drive& level, Axis axis, std::uint8_t soil) const {
  const double t = tilt_[axis], t_across = tilt_[axis == kX ? kY : kX];
  if (SlidesOnSteel(soil)) {
    const Drive slide{t + thrust_[soil] * level.along, t_across + thrust_[soil] * level.across,
                      normal_mps2_, &steel_[soil], true};
    if (Norm(slide.along, slide.across) > steel_[soil].tan_start) return slide;
  }
  const double up = std::max(kLeastUp, 1 - t * level.along - t_across * level.across);
  const double along = (level.along + t) / up, across = (level.across + t_across) / up;
  return {along, across, kStandardGravity_mps2 / std::sqrt(1 + along * along + across * across),
          level.friction};
}

/// Flux through the face between two columns at the end of the step.
Avalanche::Flux Avalanche::FluxAt(ColumnId k, ColumnId to, Axis axis, double dt_s,
                                  const Columns& ground) const {
  Flux flux{k, to, axis};
  const Columns::Skin &a = ground.skin(k), &b = ground.skin(to);
  const double cell_m = ground.cell_m();
  const double slope = (b.top_m - a.top_m) / cell_m;
  const bool downhill = slope + tilt_[axis] <= 0;
  const Columns::Skin &high = downhill ? a : b, &low = downhill ? b : a;
  if (high.top_m > low.blocked_m || !high.is_loose) return flux;
  const double before_mps = motion_[k].face_mps[axis];

  // (di, dj) points along the axis, (dj, di) across it
  const int di = axis == kX ? 1 : 0, dj = 1 - di;
  const Axis other = axis == kX ? kY : kX;
  const double across_slope =
      0.5 * (motion_[k].across_slope[axis] + motion_[to].across_slope[axis]);
  const double across_mps =
      0.25 * (motion_[k].face_mps[other] + motion_[to].face_mps[other] +
              VelocityOf(k, -dj, -di, other, ground) + VelocityOf(to, -dj, -di, other, ground));
  Drive drive{slope, across_slope, kStandardGravity_mps2, &friction_[high.soil]};
  if (is_tilted_) drive = OnFloor(drive, axis, high.soil);
  const Friction& friction = *drive.friction;
  const bool rests = before_mps == 0 && across_mps == 0;
  const bool is_steep = drive.along * drive.along + drive.across * drive.across >
                        friction.tan_start * friction.tan_start;
  if (rests && !is_steep) return flux;
  flux.along = drive.along;
  flux.gradient = Norm(drive.along, drive.across);
  flux.slides = drive.slides;

  // Upwind advection of momentum.
  const auto upstream = [&](double speed_mps, int i, int j) {
    if (speed_mps == 0) return 0.0;
    const int sign = speed_mps > 0 ? -1 : 1;
    return std::abs(speed_mps) * (before_mps - VelocityOf(k, sign * i, sign * j, axis, ground)) /
           cell_m;
  };
  const double carried_mps2 = upstream(before_mps, di, dj) + upstream(across_mps, dj, di);
  const double along_mps = before_mps - dt_s * (drive.gravity_mps2 * drive.along + carried_mps2);
  const double driven_across_mps = across_mps - dt_s * drive.gravity_mps2 * drive.across;
  const double speed_mps = Norm(along_mps, driven_across_mps);
  const double most_loose_m = std::max(a.loose_m, b.loose_m);
  // On a tilted floor, a layer thinner than one grain rolls grain by grain.
  const double thinnest_m = is_tilted_ ? std::max(kFilm_m, friction.grain_m) : kFilm_m;
  const double mobile_m = drive.slides
                              ? std::max(most_loose_m, kFilm_m)
                              : std::max({motion_[k].mobile_m, motion_[to].mobile_m, thinnest_m});
  const double left_mps = friction.Braked(Norm(before_mps, across_mps), speed_mps,
                                          {mobile_m, most_loose_m}, drive.gravity_mps2, dt_s);
  const bool creeps = left_mps < kCreep_mps || left_mps * mobile_m < kTrickle_m2ps;
  if (left_mps <= 0 || (creeps && !is_steep)) return flux;
  const double most_mps = kLongestStep_cells * cell_m / dt_s;
  flux.velocity_mps = std::clamp(along_mps * left_mps / speed_mps, -most_mps, most_mps);
  return flux;
}

void Avalanche::FindFluxes(double dt_s, const Columns& ground) {
  fluxes_.clear();
  for (const ColumnId k : visited_) {
    for (const Axis axis : {kX, kY}) {
      const ColumnId to = ground.BesideId(k, axis == kX ? 1 : 0, axis == kX ? 0 : 1);
      if (to == Columns::kNone || !is_visited_.Contains(to)) continue;
      if (motion_[k].rests && motion_[to].rests) continue;
      const Flux flux = FluxAt(k, to, axis, dt_s, ground);
      if (flux.velocity_mps != 0 || motion_[k].face_mps[axis] != 0) fluxes_.push_back(flux);
    }
  }
}

/// Sets the flowing thickness: a multiple of the soil above the slope that friction holds. Each
/// face counts its share of the full gradient.
void Avalanche::Mobilise(const Flux& flux, const Columns& ground) {
  Motion& source = motion_[flux.source()];
  const Columns::Skin& c = ground.skin(flux.source());
  if (flux.slides) {
    source.mobile_m = c.loose_m;
    return;
  }
  const double drop_m = is_tilted_ ? -std::copysign(ground.cell_m(), flux.velocity_mps) * flux.along
                                   : c.top_m - ground.skin(flux.target()).top_m;
  const double excess_m =
      drop_m * std::max(0.0, 1 - friction_[c.soil].tan_slow / std::max(flux.gradient, kLevel));
  source.mobile_m =
      std::min(c.loose_m, std::max({source.mobile_m, kFilm_m, kMobileOverExcess * excess_m}));
}

/// Thickness that a flux requests from its source in this step.
double Avalanche::Wanted_m(const Flux& flux, double dt_s, const Columns& ground) {
  const double loose_m = ground.skin(flux.source()).loose_m;
  double& velocity_mps = motion_[flux.column].face_mps[flux.axis];
  velocity_mps = loose_m > 0 ? flux.velocity_mps : 0;
  if (velocity_mps == 0) return 0;
  Mobilise(flux, ground);
  if (loose_m >= kFilm_m) {
    return std::abs(velocity_mps) * dt_s / ground.cell_m() * motion_[flux.source()].mobile_m;
  }
  velocity_mps = 0;  // a film leaves at once; its momentum is neglected
  return loose_m;
}

/// Moves loose soil by the new velocities. A column gives at most its flowing thickness.
void Avalanche::MoveSoil(double dt_s, Columns* ground) {
  moved_.clear();
  for (const Flux& flux : fluxes_) {
    const double thickness_m = Wanted_m(flux, dt_s, *ground);
    if (thickness_m <= 0) continue;
    motion_[flux.source()].outflow_m += thickness_m;
    moved_.push_back({flux.source(), flux.target(), thickness_m});
  }
  for (Columns::Transfer& moved : moved_) {
    const Motion& source = motion_[moved.from];
    if (source.outflow_m > source.mobile_m) moved.thickness_m *= source.mobile_m / source.outflow_m;
  }
  ground->Transport(moved_);
  for (const Columns::Transfer& moved : moved_) {
    motion_[moved.from].outflow_m = 0;
    motion_[moved.from].mobile_m -= moved.thickness_m;
    motion_[moved.to].mobile_m += moved.thickness_m;
  }
}

/// Lets unstable banks fail. All are judged by the same state of the ground.
void Avalanche::FailWalls(double dt_s, Columns* ground, Grains* grains) {
  std::vector<StandingWalls::Failure> failures;
  for (const ColumnId k : visited_) {
    if (const auto failure = walls_.FailureAt(k, *ground)) failures.push_back(*failure);
  }
  if (++steps_ % kStepsPerLoad == 0) {
    ColumnSet seen;
    StandingWalls::ForLoaded(ground, [&](ColumnId k) {
      if (is_visited_.Contains(k) || seen.Contains(k)) return;
      seen.Add(k);
      if (const auto failure = walls_.FailureAt(k, *ground)) failures.push_back(*failure);
    });
  }
  walls_.Fail(failures, dt_s, ground, grains);
}

void Avalanche::Flow(double dt_s, Columns* ground, Grains* grains) {
  pending_s_ += dt_s;
  if (pending_s_ + 0.5 * dt_s < kStep_s) return;
  Step(std::exchange(pending_s_, 0), ground, grains);
}

void Avalanche::Step(double dt_s, Columns* ground, Grains* grains) {
  for (const ColumnId k : ground->TakeChanged()) Wake(k, ground);
  motion_.resize(ground->id_end());
  is_visited_.clear();
  std::swap(active_, is_visited_);
  is_visited_.ListTo(&visited_);
  FailWalls(dt_s, ground, grains);
  for (const ColumnId k : visited_) LookAround(k, *ground);
  FindFluxes(dt_s, *ground);
  for (const ColumnId k : visited_) {
    if (!Flows(k, *ground)) motion_[k].mobile_m = 0;
  }
  MoveSoil(dt_s, ground);
}

}  // namespace tera
