#include "soil/flow/grains.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kClod_m3 = 1e-4;  ///< about 6 cm across
/// growth of the clod volume when the number of clods is at its limit
constexpr double kLargestClods = 8;
/// used share of the remaining clods; the rest covers rounding to whole clods in each column
constexpr double kUseOfRoom = 0.8;
constexpr double kLongestSlide_s = 3;    ///< a clod rests after this time
constexpr double kRestSpeed_mps = 0.05;  ///< slower clods rest where friction holds them
constexpr double kScatter_mps = 0.15;    ///< standard deviation of a clod's velocity on each axis
constexpr int kMostFalls = 40;           ///< most columns over which deposited soil falls on
constexpr double kSteep = 1;             ///< slope to a neighbour that a clod does not spread to
constexpr double kWall = 2;              ///< slope that a clod does not climb

/// Moves `at` to the lowest neighbour if soil on `at` would fall off as off a wall. True if it
/// moved.
bool FallsOn(const Columns& ground, Columns::Place* at) {
  if (!ground.Contains(at->i, at->j)) return false;
  const double edge_m = ground.TopAt(at->i, at->j) - kWall * ground.cell_m();
  double lowest_m = edge_m;
  Columns::Place lowest = *at;
  for (int dj = -1; dj <= 1; ++dj) {
    for (int di = -1; di <= 1; ++di) {
      if (!ground.Contains(at->i + di, at->j + dj)) continue;
      const double top_m = ground.TopAt(at->i + di, at->j + dj);
      if (top_m < lowest_m) lowest_m = top_m, lowest = {at->i + di, at->j + dj};
    }
  }
  *at = lowest;
  return lowest_m < edge_m;
}

Columns::Place NearestPlace(const Columns& ground, const Vec3& p_W_m) {
  return {ground.NearestI(p_W_m.x()), ground.NearestJ(p_W_m.y())};
}

/// Deposits soil at a column, or where it falls from there, in parcels no thicker than a cell.
void PutDown(const Columns::Place& place, Spoil spoil, Columns* ground) {
  const double cell_m3 = ground->cell_m() * ground->area_m2();
  for (int n = static_cast<int>(std::ceil(spoil.volume_m3 / cell_m3)); n > 0; --n) {
    Columns::Place at = place;
    for (int k = 0; k < kMostFalls && FallsOn(*ground, &at); ++k) {
    }
    ground->DepositAt(at.i, at.j, spoil.Take(1.0 / n));
  }
}

/// Spreads soil over the four columns around a point so that its centre stays there. Skips columns
/// that rise beside the point like a wall.
void Spread(const Vec3& p_W_m, const Spoil& spoil, Columns* ground) {
  auto [i, j] = NearestPlace(*ground, p_W_m);
  if (ground->x_m(i) > p_W_m.x()) --i;
  if (ground->y_m(j) > p_W_m.y()) --j;
  const auto put = [&](const Columns::Place& at, const Spoil& part) {
    const bool is_wall = ground->Contains(at.i, at.j) &&
                         ground->TopAt(at.i, at.j) > p_W_m.z() + kSteep * ground->cell_m();
    PutDown(is_wall ? NearestPlace(*ground, p_W_m) : at, part, ground);
  };
  Spoil here = spoil;
  Spoil beside = here.Take((p_W_m.x() - ground->x_m(i)) / ground->cell_m());
  for (const int di : {0, 1}) {
    Spoil& near = di == 0 ? here : beside;
    const Spoil far = near.Take((p_W_m.y() - ground->y_m(j)) / ground->cell_m());
    put({i + di, j}, near);
    put({i + di, j + 1}, far);
  }
}

/// True if the loose soil at the point is thicker than the clod's radius and so absorbs it.
bool TakesIn(const Columns& ground, const Vec3& p_W, double radius_m) {
  const auto [i, j] = NearestPlace(ground, p_W);
  const ColumnId k = ground.IdAt(i, j);
  return k != Columns::kNone && ground.skin(k).is_loose && ground.skin(k).loose_m > radius_m;
}

/// Reduces the speed by up to `loss_mps`.
Vec3 Slowed(const Vec3& v_mps, double loss_mps) {
  const double speed_mps = v_mps.norm();
  return speed_mps > loss_mps ? Vec3(v_mps * (1 - loss_mps / speed_mps)) : Vec3(Vec3::Zero());
}

}  // namespace

Grains::Grains(const std::vector<SoilType>& soils, std::uint64_t seed)
    : scatter_(seed, "terrain/grains") {
  for (const SoilType& soil : soils) {
    friction_.push_back(std::tan(soil.repose_angle_rad));
    bank_kgpm3_.push_back(soil.bank_density_kgpm3);
  }
}

double Grains::clod_m3() const {
  return kClod_m3 * (1 + (kLargestClods - 1) * static_cast<double>(count()) / kMostClods);
}

double Grains::RoomyClod_m3(double volume_m3) const {
  const std::size_t room = std::max(kMostClods - std::min(kMostClods, count()), kMostClods / 10);
  return volume_m3 / (kUseOfRoom * static_cast<double>(room));
}

void Grains::Pour(const SpoilMix& spoil, const Vec3& from_W, const Vec3& to_W, const Vec3& v_W,
                  Columns* ground) {
  Pour(spoil, from_W, to_W, clod_m3(), {.v_W_mps = v_W, .kind = Kind::kLoose}, ground);
}

void Grains::Pour(const Broken& broken, double least_m3, Columns* ground) {
  Pour(broken.soil, broken.low_W_m, broken.high_W_m, std::max(least_m3, clod_m3()),
       {.v_W_mps = Vec3::Zero(),
        .kind = Kind::kFirm,
        .slide_W_mps2 = broken.slide_W_mps2.cast<float>(),
        .way_m = static_cast<float>(broken.way_m),
        .of_way_m = static_cast<float>(broken.way_m),
        .is_free = broken.way_m <= 0 || broken.slide_W_mps2.isZero()},
       ground);
}

void Grains::Pour(const SpoilMix& spoil, const Vec3& from_W, const Vec3& to_W, double each_m3,
                  const Grain& like, Columns* ground) {
  for (Spoil rest : spoil.parts()) {
    const int clods = std::max(1, static_cast<int>(std::lround(rest.volume_m3 / each_m3)));
    for (int n = clods; n > 0; --n) {
      Grain clod = like;
      clod.spoil = rest.Take(1.0 / n);
      const std::uint64_t k = poured_++;
      clod.p_W_m = from_W + scatter_.Uniform(k, 1) * (to_W - from_W);
      if (count() < kMostClods) {
        clod.v_W_mps += kScatter_mps * scatter_.Gaussian3(k, 2);
        clod.number = static_cast<std::uint16_t>(k);
        clod.radius_m = static_cast<float>(std::cbrt(3 * clod.spoil.volume_m3 / (4 * kPi)));
        grains_.push_back(clod);
      } else {
        LayDown(clod.p_W_m, clod.spoil, clod.kind, ground);
      }
    }
  }
}

Bed* Grains::BedAt(const Vec3& p_W_m) {
  const auto bed =
      std::find_if(beds_.begin(), beds_.end(), [&](const Bed& b) { return b.Holds(p_W_m); });
  return bed == beds_.end() ? nullptr : &*bed;
}

void Grains::LayDown(const Vec3& p_W_m, const Spoil& spoil, Kind kind, Columns* ground) {
  if (Bed* bed = BedAt(p_W_m)) {
    bed->Deposit(p_W_m, spoil);
  } else if (kind == Kind::kFirm) {
    PutDown(NearestPlace(*ground, p_W_m), spoil, ground);
  } else {
    Spread(p_W_m, spoil, ground);
  }
}

/// The soil that a clod becomes. Soil of a bank has swollen in proportion to the way it has slid.
Spoil Grains::Loosened(const Grain& grain) const {
  Spoil spoil = grain.spoil;
  if (grain.way_m <= 0) return spoil;
  const double bank_m3 = spoil.mass_kg / bank_kgpm3_[spoil.soil];
  spoil.volume_m3 += (bank_m3 - spoil.volume_m3) * grain.way_m / grain.of_way_m;
  return spoil;
}

/// Slides a clod with its bank. The slide ends after the bank's way or when the clod meets ground.
bool Grains::GoesWithBank(double dt_s, const Columns& ground, Grain* grain) {
  const Vec3 v_W = grain->v_W_mps + dt_s * grain->slide_W_mps2.cast<double>();
  const Vec3 p_W = grain->p_W_m + dt_s * v_W;
  grain->way_m -= static_cast<float>(dt_s * v_W.norm());
  const bool goes_on =
      grain->way_m > 0 && p_W.z() + grain->radius_m > ground.HeightAt(p_W.x(), p_W.y());
  if (!goes_on) {
    grain->way_m = std::max(0.0F, grain->way_m);
    grain->is_free = true;
    return false;
  }
  grain->v_W_mps = v_W;
  grain->p_W_m = p_W;
  return true;
}

/// Lifts a sliding clod onto soil that has risen under it. False if its kinetic energy does not
/// suffice, so that it is buried.
bool Grains::RisesWithGround(const Columns& ground, Grain* grain) {
  const double rise_m = ground.HeightAt(grain->p_W_m.x(), grain->p_W_m.y()) - grain->p_W_m.z();
  if (rise_m <= 0) return true;
  const double v2 = grain->v_W_mps.squaredNorm();
  const double left2 = v2 - 2 * kStandardGravity_mps2 * rise_m;
  if (left2 <= 0) return false;
  grain->v_W_mps *= std::sqrt(left2 / v2);
  grain->p_W_m.z() += rise_m;
  return true;
}

bool Grains::Move(double dt_s, const Vec3& up, const Columns& ground, Grain* grain) const {
  Vec3 &p_W = grain->p_W_m, &v_W = grain->v_W_mps;
  const Vec3 before_W = p_W;
  if (!grain->is_free && GoesWithBank(dt_s, ground, grain)) return false;
  if (grain->kind == Kind::kFirm && grain->slid_s > 0 && !RisesWithGround(ground, grain)) {
    return true;
  }
  v_W -= dt_s * kStandardGravity_mps2 * up;
  p_W += dt_s * v_W;
  if (ground.IsWellAbove(p_W)) return false;
  double ground_m = ground.HeightAt(p_W.x(), p_W.y());
  if (p_W.z() > ground_m) return false;
  grain->slid_s += dt_s;
  Vec3 n_W = ground.NormalAt(p_W.x(), p_W.y());
  if (n_W.head<2>().norm() > kWall * n_W.z() && n_W.head<2>().dot(v_W.head<2>()) < 0) {
    p_W.head<2>() = before_W.head<2>();
    v_W.head<2>().setZero();
    ground_m = ground.HeightAt(p_W.x(), p_W.y());
    if (p_W.z() > ground_m) return false;
    n_W = ground.NormalAt(p_W.x(), p_W.y());
  }
  p_W.z() = ground_m;
  if (grain->kind == Kind::kLoose && TakesIn(ground, p_W, grain->radius_m)) return true;
  const double into_mps = std::max(0.0, -v_W.dot(n_W));
  const double friction = friction_[grain->spoil.soil];
  v_W = Slowed(v_W + into_mps * n_W, friction * into_mps);
  const bool holds = n_W.cross(up).norm() <= friction * n_W.dot(up);
  return (holds && v_W.norm() < kRestSpeed_mps) || grain->slid_s > kLongestSlide_s;
}

/// Move in the frame of the floor of a bed.
bool Grains::MoveInBed(double dt_s, const Bed& bed, Grain* grain) const {
  const Pose& X_WF = bed.X_WF();
  Grain in_F = *grain;
  in_F.p_W_m = X_WF.inverse() * grain->p_W_m;
  in_F.v_W_mps = X_WF.linear().transpose() * grain->v_W_mps;
  const bool rests = Move(dt_s, bed.up_F(), bed.columns(), &in_F);
  bed.KeepWithinWalls(&in_F.p_W_m, &in_F.v_W_mps);
  grain->p_W_m = X_WF * in_F.p_W_m;
  grain->v_W_mps = X_WF.linear() * in_F.v_W_mps;
  grain->slid_s = in_F.slid_s;
  return rests;
}

void Grains::Step(double dt_s, Columns* ground) {
  if (grains_.empty() && beds_.empty()) return;
  const bool has_beds = !beds_.empty();
  for (std::size_t n = 0; n < grains_.size();) {
    Grain& grain = grains_[n];
    const Bed* bed = has_beds ? BedAt(grain.p_W_m) : nullptr;
    if (bed != nullptr ? MoveInBed(dt_s, *bed, &grain)
                       : Move(dt_s, Vec3::UnitZ(), *ground, &grain)) {
      LayDown(grain.p_W_m, Loosened(grain), grain.kind, ground);
      grain = grains_.back();
      grains_.pop_back();
    } else {
      ++n;
    }
  }
  Show(ground);
}

void Grains::Show(Columns* ground) const {
  std::vector<TerrainSurface::Grain> shown;
  shown.reserve(grains_.size());
  for (const Grain& grain : grains_) {
    shown.push_back({grain.p_W_m.cast<float>() + grain.radius_m * Eigen::Vector3f::UnitZ(),
                     grain.radius_m, grain.number, grain.spoil.soil,
                     static_cast<std::uint8_t>(255 * grain.spoil.moisture + 0.5F)});
  }
  for (const Bed& bed : beds_) bed.Show(&shown);
  ground->ShowGrains(std::move(shown));
}

double Grains::mass_kg() const {
  double sum_kg = 0;
  for (const Grain& grain : grains_) sum_kg += grain.spoil.mass_kg;
  return sum_kg;
}

}  // namespace tera
