#include "layout/measures/shovel_view.h"

#include <algorithm>

#include "layout/sight/look.h"

namespace tera {
namespace {

constexpr int kAlongEdge = 21, kAcrossMouth = 9;

}  // namespace

ShovelView::ShovelView(const Shovel& shovel, std::uint16_t instance)
    : name_(shovel.name),
      link_(shovel.link),
      carries_(shovel.capacity_m3 > 0),
      soil_instance_(instance) {
  const Vec2 edge = shovel.profile_B_m.front(), lip = shovel.profile_B_m.back();
  for (int i = 0; i < kAlongEdge; ++i) {
    const double y_m = shovel.width_m * ((i + 0.5) / kAlongEdge - 0.5);
    edge_B_m_.emplace_back(edge.x(), y_m, edge.y());
    for (int j = 0; j < kAcrossMouth; ++j) {
      const Vec2 p = lip + (j + 0.5) / kAcrossMouth * (edge - lip);
      mouth_B_m_.emplace_back(p.x(), y_m, p.y());
    }
  }
}

double ShovelView::ShareSeen(const std::vector<Vec3>& places_W_m, const Layout& layout,
                             double reflectance, const Sighting& sighting) const {
  const std::vector<Target> targets = InTheAir(places_W_m);
  std::vector<bool> seen(places_W_m.size(), false);
  for (const Viewer& viewer : layout.viewers) {
    const std::vector<Look> looks =
        LookFrom(viewer, targets, {.reflectance = reflectance}, sighting);
    for (std::size_t p = 0; p < looks.size(); ++p) {
      const bool by_soil = looks[p].why == Unseen::kBlocked && soil_instance_ != 0 &&
                           looks[p].by.instance == soil_instance_;
      if (looks[p].sees || by_soil) seen[p] = true;
    }
  }
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) /
         static_cast<double>(places_W_m.size());
}

void ShovelView::Add(const MachineState& machine, const Layout& layout, double reflectance,
                     const Sighting& sighting) {
  const Pose& X_WB = machine.links[link_].X_WB;
  const auto in_W = [&](const std::vector<Vec3>& places_B_m) {
    std::vector<Vec3> places_W_m;
    for (const Vec3& p_B_m : places_B_m) places_W_m.push_back(X_WB * p_B_m);
    return places_W_m;
  };
  edge_seen_.push_back(ShareSeen(in_W(edge_B_m_), layout, reflectance, sighting));
  if (carries_) load_seen_.push_back(ShareSeen(in_W(mouth_B_m_), layout, reflectance, sighting));
}

std::vector<Figure> ShovelView::Figures() const {
  const auto figure = [&](Measure measure, const std::vector<double>& at, std::size_t places) {
    Figure f{{measure, name_}, at, {}};
    for (const double share : at) f.error.push_back(ShareError(share, places));
    return f;
  };
  std::vector<Figure> figures = {figure(Measure::kEdgeSeen, edge_seen_, edge_B_m_.size())};
  if (carries_) figures.push_back(figure(Measure::kLoadSeen, load_seen_, mouth_B_m_.size()));
  return figures;
}

}  // namespace tera
