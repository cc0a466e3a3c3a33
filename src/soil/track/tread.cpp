#include "soil/track/tread.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "soil/columns/soil_type.h"

namespace tera {
namespace {

/// Amplitude of a wave of `length_m` after averaging over `width_m`.
double Averaged(double width_m, double length_m) {
  const double half_angle = kPi * width_m / length_m;
  return std::sin(half_angle) / half_angle;
}

/// Loose volume over present volume of the soil at the surface of a column.
double Loosened(const Column& column, const Stratum& bank, const std::vector<SoilType>& soils) {
  const SoilLayer* top = column.top_layer();
  if (top == nullptr) return bank.density_kgpm3 / LooseDensity_kgpm3(soils[bank.soil]);
  return top->loose ? 1 : top->density_kgpm3() / LooseDensity_kgpm3(soils[top->soil]);
}

}  // namespace

Tread::Tread(const RunningGear& gear) : pitch_m_(gear.grouser_pitch_m), height_m_(gear.grouser_m) {
  for (const ContactPatch& patch : gear.patches) {
    middle_B_m_ += patch.p_B_m.x() / gear.patches.size();
  }
}

void Tread::Print(ColumnId k, const Pose& X_WB, Columns* ground) const {
  const double cell_m = ground->cell_m();
  if (height_m_ <= 0 || cell_m > 0.5 * pitch_m_) return;
  const auto [i, j] = ground->PlaceOf(k);
  const Vec3 p_W(ground->x_m(i), ground->y_m(j), ground->skin(k).top_m);
  const double x_B_m = (X_WB.inverse() * p_W).x();
  const double wave = std::cos(2 * kPi * (x_B_m + travel_m_) / pitch_m_);
  if (wave >= 0) return;  // crests get their soil from troughs

  const double outward_m = std::copysign(0.5 * pitch_m_, x_B_m - middle_B_m_);
  const Vec3 q_W = p_W + outward_m * X_WB.linear().col(0);
  const ColumnId to = ground->IdAt(ground->NearestI(q_W.x()), ground->NearestJ(q_W.y()));
  if (to == Columns::kNone || to == k || ground->IsBlocked(to)) return;
  const auto [to_i, to_j] = ground->PlaceOf(to);
  const Vec3 crest_W(ground->x_m(to_i), ground->y_m(to_j), ground->skin(to).top_m);
  // height above the column in the track's plane
  const double stands_m = (crest_W - p_W).dot(X_WB.linear().col(2));

  const double height_m = std::min(height_m_, ground->skin(k).pressed_m);
  const double missing_m = -wave * Averaged(cell_m, pitch_m_) * height_m - stands_m;
  if (missing_m <= 0) return;
  SpoilMix moved;
  ground->Scrape(k, missing_m / (1 + Loosened(ground->at(k), ground->BankOf(k), ground->soils())),
                 &moved);
  ground->Deposit(to, moved);
}

}  // namespace tera
