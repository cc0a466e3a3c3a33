#include "soil/track/rut.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "soil/track/side_faces.h"
#include "soil/track/terramechanics.h"

namespace tera {
namespace {

constexpr double kInfluenceDepths = 1.0;  ///< depth of compaction over patch width
constexpr double kMostShare = 2;          ///< upper bound of PressureShare
/// The fractional parts of its multiples fill 0 to 1 evenly for any count.
constexpr double kGolden = 0.6180339887498949;
constexpr double kScraped_m = 5e-4;  ///< soil is carried away in layers this thick

/// Calls visit(i, j, d_W) for each column under a patch. d_W points from the middle of the patch to
/// the column, in the plane of the patch.
template <typename Visit>
void ForColumnsUnder(const ContactPatch& patch, const Footprint& foot, const Columns& ground,
                     Visit visit) {
  const Vec3& p_W = foot.p_W_m;
  const Vec2 rise = -foot.n_W.head<2>() / foot.n_W.z();  // gradient of the plane
  const Vec2 along = foot.along_W.head<2>() + foot.along_W.z() * rise;
  const Vec2 across = foot.across_W.head<2>() + foot.across_W.z() * rise;
  const Vec3 reach =
      0.5 * (patch.length_m * foot.along_W.cwiseAbs() + patch.width_m * foot.across_W.cwiseAbs());
  const int i0 = std::max(0, ground.NearestI(p_W.x() - reach.x()));
  const int i1 = std::min(ground.nx() - 1, ground.NearestI(p_W.x() + reach.x()));
  const int j0 = std::max(0, ground.NearestJ(p_W.y() - reach.y()));
  const int j1 = std::min(ground.ny() - 1, ground.NearestJ(p_W.y() + reach.y()));
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      const Vec2 d(ground.x_m(i) - p_W.x(), ground.y_m(j) - p_W.y());
      if (std::abs(d.dot(along)) > 0.5 * patch.length_m) continue;
      if (std::abs(d.dot(across)) > 0.5 * patch.width_m) continue;
      visit(i, j, Vec3(d.x(), d.y(), d.dot(rise)));
    }
  }
}

/// Share of the pressing work that forward motion may do. Soil that enters from the side is pushed
/// by the side face. A patch that faces backwards does not press soil by moving forwards.
double ForwardShare(const Footprint& foot, const BodyState& body, const Vec3& v_W) {
  constexpr double kFlat = 1e-6;
  const double along_mps = v_W.dot(foot.along_W), across_mps = v_W.dot(foot.across_W);
  const double squared = along_mps * along_mps + across_mps * across_mps;
  const Vec3 up_W = body.X_WB.linear().col(2);
  const double meets_mps = (v_W - v_W.dot(up_W) * up_W).dot(foot.n_W);
  if (squared == 0 || meets_mps < -kFlat * std::sqrt(squared)) return 0;
  return along_mps * along_mps / squared;
}

}  // namespace

Rut::Rut(const RunningGear& gear, const std::vector<SoilType>& soils)
    : gear_(gear),
      soils_(soils),
      plates_(PlatesOf(gear_, soils_)),
      tread_(gear),
      scrape_m_(gear.patches.size(), 0.0) {}

void Rut::Begin(double shoe_m, Columns* ground) {
  tread_.Roll(shoe_m);
  for (const ColumnId k : covered_) ground->Release(k);
  was_covered_ = std::exchange(covered_, {});
  was_touching_ = std::exchange(touching_, {});
}

/// A column under a patch.
struct Rut::Under {
  ColumnId id;
  std::size_t patch;
  const Footprint& foot;
  Vec3 d_W_m;                ///< from the middle of the patch, in its plane
  double middle_m, width_m;  ///< middle and width, across, of the touching part of the patch
  double along_m() const { return d_W_m.dot(foot.along_W); }
  double across_m() const { return d_W_m.dot(foot.across_W); }
};

void Rut::Cover(ColumnId k, double low_m, Columns* ground) {
  ground->MarkRut(k);
  ground->Block(k, low_m);
  covered_.push_back(k);
}

double Rut::Press(std::size_t patch_index, const Footprint& foot, double touching,
                  const BodyState& body, double dt_s, const LowObstacles& obstacles,
                  Columns* ground) {
  pressed_.clear();
  const ContactPatch& patch = gear_.patches[patch_index];
  const bool side = SideFaces::IsOne(patch);
  const double middle_m = side ? SideFaces::Middle_m(patch, touching) : 0;
  const double climb_m = ClimbHeight_m(gear_);
  double work_j = 0;
  ForColumnsUnder(patch, foot, *ground, [&](int i, int j, const Vec3& d_W) {
    if (side && std::abs(d_W.dot(foot.across_W) - middle_m) > 0.5 * touching * patch.width_m) {
      return;
    }
    ColumnId k = ground->IdAt(i, j);
    const double top_m = k != Columns::kNone ? ground->skin(k).top_m : ground->TopAt(i, j);
    const double patch_z_m = foot.p_W_m.z() + d_W.z();
    const double pen_m = (top_m - patch_z_m) * -foot.n_W.z();
    if (pen_m <= 0) return;
    const auto obstacle = obstacles.TopAt(ground->x_m(i), ground->y_m(j), climb_m);
    if (obstacle && obstacle->z_m > top_m) return;
    if (k == Columns::kNone) k = ground->Touch(i, j);
    Cover(k, patch_z_m, ground);
    pressed_.push_back(k);
    work_j += Sink({k, patch_index, foot, d_W, middle_m, touching * patch.width_m}, pen_m, body,
                   dt_s, ground);
  });
  if (!pressed_.empty() && !side) touching_.push_back(patch_index);
  return work_j;
}

/// Place of the heave of a column: beside the gear on the nearer side. For a side face that faces
/// down, it is the side to which it faces.
Rut::Beside Rut::BesideOf(const Under& column, const Plate& plate, double cell_m) const {
  const Footprint& foot = column.foot;
  const Vec2 p_W_m = (foot.p_W_m + column.d_W_m).head<2>();
  if (SideFaces::IsOne(gear_.patches[column.patch])) {
    const Vec2 out_W = foot.n_W.head<2>().normalized();
    return {p_W_m + (cell_m - column.width_m * foot.n_W.z()) * out_W, out_W, plate.heave_reach_m()};
  }
  const double from_middle_m = column.across_m() - column.middle_m;
  const double out_m = 0.5 * column.width_m + cell_m - std::abs(from_middle_m);
  const Vec2 out_W = std::copysign(1.0, from_middle_m) * foot.across_W.head<2>().normalized();
  return {p_W_m + out_m * out_W, out_W, plate.heave_reach_m()};
}

/// Width of a patch over the total width of the columns in a row below it. It makes the work of a
/// row independent of its number of columns, for example 7 or 8 cells of 4 cm under 0.3 m.
double Rut::RowShare(const Under& column, double cell_m) {
  const double from_middle_m = column.across_m() - column.middle_m;
  const double to_left = (0.5 * column.width_m - from_middle_m) / cell_m;
  const double to_right = (0.5 * column.width_m + from_middle_m) / cell_m;
  const double count = 1 + std::floor(std::max(0.0, to_left)) + std::floor(std::max(0.0, to_right));
  return column.width_m / (count * cell_m);
}

/// Lets a column yield to a patch with penetration `pen_m`. Returns the work that the pressure of
/// the patch does not do.
double Rut::Sink(const Under& column, double pen_m, const BodyState& body, double dt_s,
                 Columns* ground) {
  const ColumnId k = column.id;
  const std::size_t patch_index = column.patch;
  const Footprint& foot = column.foot;
  const Vec3& d_W = column.d_W_m;
  const ContactPatch& patch = gear_.patches[patch_index];
  const Plate& plate = plates_[patch_index * soils_.size() + ground->soil_at(k)];
  const double was_m = ground->skin(k).pressed_m;
  if (plate.Bears(kMostShare * plate.rebound_papm() * pen_m, was_m)) return 0;
  const double share = PressureShare(patch, column.along_m());
  const double plastic_m = plate.PlasticSinkage_m(share, 1, was_m, pen_m);
  if (plastic_m <= 0) return 0;
  const Vec3 v_W =
      body.v_WB_mps + body.w_WB_radps.cross(foot.p_W_m + d_W - body.X_WB.translation());
  // A patch that sinks vertically compacts soil; one that moves along also pushes it aside.
  const double forward = ForwardShare(foot, body, v_W);
  const double moved_on =
      forward * (1 - std::clamp(v_W.dot(foot.n_W) * dt_s / plastic_m, 0.0, 1.0));
  const double came_along =
      forward * (1 - std::clamp(v_W.z() * foot.n_W.z() * dt_s / plastic_m, 0.0, 1.0));
  const double is_m = was_m + plastic_m;
  const double firmness = static_cast<double>(ground->skin(k).firmness);
  const double pressure_pa = firmness * share * plate.rebound_papm() * (pen_m - plastic_m);
  Lower(k, {plastic_m / -foot.n_W.z(), kInfluenceDepths * patch.width_m, pressure_pa},
        BesideOf(column, plate, ground->cell_m()), ground);
  if (forward == 0) return 0;
  return firmness * RowShare(column, ground->cell_m()) * ground->area_m2() *
         (moved_on * plate.PressingWork_jpm2(was_m, is_m) +
          came_along * plate.BulldozingWork_jpm2(was_m, is_m));
}

void Rut::Lower(ColumnId k, const Pressing& pressing, const Beside& beside, Columns* ground) {
  SpoilMix heaves;
  ground->Press(k, pressing, &heaves);
  if (heaves.empty()) return;
  const double share = kGolden * heaved_++;
  const double out = 1 - std::sqrt(share - std::floor(share));
  const Vec2 p_W_m = beside.edge_W_m + out * beside.reach_m * beside.out_W;
  ground->DepositAt(ground->NearestI(p_W_m.x()), ground->NearestJ(p_W_m.y()), heaves);
}

void Rut::Slip(std::size_t k, double slip_m, double sinkage_m, double contact_m,
               const BodyState& body, Columns* ground) {
  if (pressed_.empty()) return;
  scrape_m_[k] += std::min(gear_.grouser_m, sinkage_m) * slip_m / contact_m;
  if (std::abs(scrape_m_[k]) < kScraped_m) return;
  const double scraped_m = std::exchange(scrape_m_[k], 0.0);
  SpoilMix thrown;
  for (const ColumnId column : pressed_) ground->Scrape(column, std::abs(scraped_m), &thrown);
  ThrowOut(std::copysign(1.0, scraped_m), body, thrown, ground);
}

/// Deposits soil at the end of the contact, in `direction` times travel.
void Rut::ThrowOut(double direction, const BodyState& body, const SpoilMix& thrown,
                   Columns* ground) {
  std::size_t last = touching_.front();
  const Vec3 backward_B = -direction * Vec3::UnitX();
  for (const std::size_t k : was_touching_) {
    if (gear_.patches[k].p_B_m.dot(backward_B) > gear_.patches[last].p_B_m.dot(backward_B)) {
      last = k;
    }
  }
  const ContactPatch& patch = gear_.patches[last];
  const Footprint foot(patch, body.X_WB);
  const Vec3 end_W =
      foot.p_W_m + direction * (0.5 * patch.length_m + ground->cell_m()) * foot.along_W;
  const int count = std::max(1, static_cast<int>(patch.width_m / ground->cell_m()));
  SpoilMix rest = thrown;
  for (int n = 0; n < count; ++n) {
    const Vec3 p_W = end_W + ((n + 0.5) / count - 0.5) * patch.width_m * foot.across_W;
    ground->DepositAt(ground->NearestI(p_W.x()), ground->NearestJ(p_W.y()),
                      rest.Take(1.0 / (count - n)));
  }
}

void Rut::End(const BodyState& body, double weight_n, Columns* ground) {
  ground->Load(covered_, weight_n / (static_cast<double>(covered_.size()) * ground->area_m2()));
  std::vector<ColumnId> free;
  for (const ColumnId k : was_covered_) {
    if (!ground->IsBlocked(k)) free.push_back(k);
  }
  std::sort(free.begin(), free.end());  // some columns lay under two patches
  free.erase(std::unique(free.begin(), free.end()), free.end());
  for (const ColumnId k : free) {
    tread_.Print(k, body.X_WB, ground);
    ground->Unblock(k);
  }
}

}  // namespace tera
