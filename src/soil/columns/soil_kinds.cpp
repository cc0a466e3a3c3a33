#include "soil/columns/soil_kinds.h"

#include <algorithm>
#include <cmath>

#include "soil/columns/soil_water.h"

namespace tera {
namespace {

constexpr int kSteps_percent[] = {1, 2, 5, 10, 20};

int PerCent(double moisture) {
  return static_cast<int>(std::lround(100 * std::clamp(moisture, 0.0, 1.0)));
}

}  // namespace

SoilKinds::SoilKinds(std::vector<SoilType> soils) : soils_(std::move(soils)) {
  for (std::size_t k = 0; k < soils_.size(); ++k) {
    given_.push_back(static_cast<std::uint8_t>(k));
    kind_at_.emplace_back().fill(-1);
    kind_at_.back()[PerCent(soils_[k].moisture)] = static_cast<int>(k);
  }
}

std::uint8_t SoilKinds::At(std::uint8_t kind, double moisture) const {
  const Row& row = kind_at_[given_[kind]];
  const int wanted = PerCent(moisture);
  for (int off = 0; off <= kPerCent; ++off) {
    for (const int at : {wanted - off, wanted + off}) {
      if (at >= 0 && at <= kPerCent && row[at] >= 0) return static_cast<std::uint8_t>(row[at]);
    }
  }
  return kind;
}

bool SoilKinds::Add(std::uint8_t kind, double moisture) {
  const std::uint8_t given = given_[kind];
  int& at = kind_at_[given][PerCent(moisture)];
  if (at >= 0 || !soils_[given].water.holds()) return true;
  if (soils_.size() == kMost) return false;
  at = static_cast<int>(soils_.size());
  given_.push_back(given);
  soils_.push_back(AtMoisture(soils_[given], static_cast<double>(PerCent(moisture)) / kPerCent));
  return true;
}

bool SoilKinds::AddHidden() {
  const auto driest = [](const SoilType& soil) {
    return PerCent(std::min(soil.moisture, soil.water.residual));
  };
  const std::size_t given = kind_at_.size();
  for (const int step : kSteps_percent) {
    std::size_t more = 0;
    for (std::size_t k = 0; k < given; ++k) {
      if (!soils_[k].water.holds()) continue;
      more += static_cast<std::size_t>((kPerCent - driest(soils_[k])) / step + 1);
    }
    if (soils_.size() + more > kMost) continue;
    shown_ = soils_.size();
    for (std::size_t k = 0; k < given; ++k) {
      for (int at = kPerCent; at >= driest(soils_[k]); at -= step) {
        Add(static_cast<std::uint8_t>(k), static_cast<double>(at) / kPerCent);
      }
    }
    for (std::size_t k = shown_; k < soils_.size(); ++k) {
      soils_[k].unwetted_density_kgpm3 = soils_[given_[k]].bank_density_kgpm3;
      soils_[k].unwetted_moisture = soils_[given_[k]].moisture;
    }
    return true;
  }
  return false;
}

}  // namespace tera
