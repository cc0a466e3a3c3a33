#include "soil/site.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "soil/geotiff.h"
#include "soil/relief.h"
#include "soil/soil_type.h"

namespace tera {
namespace {

constexpr double kDefaultSize_m = 40, kDefaultCell_m = 0.05;
constexpr double kMostColumns = 5e7;  ///< about 8 GB
constexpr std::size_t kMostSoils = 255;

/// The soils that a site names, each once.
class SoilCatalogue {
 public:
  explicit SoilCatalogue(const ConfigMap& config) {
    for (const ConfigMap& custom : config.List("custom_soils")) {
      custom.ApplyPreset("preset");
      const SoilType soil = ReadSoilType(custom);
      if (Find(soil.name)) custom.Fault("name", fmt::format("second soil named '{}'", soil.name));
      soils_.push_back(soil);
    }
  }

  /// Index of the soil of that name; a shipped soil is loaded when it is first named.
  std::uint8_t Index(const ConfigMap& at, std::string_view key, const std::string& name) {
    if (const auto known = Find(name)) return *known;
    if (soils_.size() >= kMostSoils) {
      at.Fault(key, fmt::format("more than {} soils", kMostSoils));
      return 0;
    }
    const auto file = ShippedSoilFile(name);
    if (!file) {
      at.Fault(key, fmt::format("no soil named '{}'; need one of {} or a name in custom_soils",
                                name, ShippedSoilNames()));
      return 0;
    }
    const Config preset = Config::FromFile(*file);
    soils_.push_back(ReadSoilType(preset.root()));
    preset.Finish();
    return static_cast<std::uint8_t>(soils_.size() - 1);
  }

  std::vector<SoilType> Take() { return std::move(soils_); }

 private:
  std::optional<std::uint8_t> Find(const std::string& name) const {
    for (std::size_t k = 0; k < soils_.size(); ++k) {
      if (soils_[k].name == name) return static_cast<std::uint8_t>(k);
    }
    return std::nullopt;
  }

  std::vector<SoilType> soils_;
};

struct Strip {
  int axis = 0;
  double from_m = 0, to_m = 0;
  std::uint8_t soil = 0;
};

std::vector<Strip> ReadStrips(const ConfigMap& config, SoilCatalogue* soils) {
  std::vector<Strip> strips;
  for (const ConfigMap& item : config.List("strips")) {
    Strip strip;
    strip.axis = item.Choice("axis", {"x", "y"}, "x") == "x" ? 0 : 1;
    strip.from_m = item.Number("from_m", Any("m"));
    strip.to_m = item.Number("to_m", Any("m"));
    strip.soil = soils->Index(item, "soil", item.Text("soil"));
    if (strip.to_m <= strip.from_m) {
      item.Fault("to_m", fmt::format("{} is not beyond from_m {}", strip.to_m, strip.from_m));
    }
    for (const Strip& other : strips) {
      if (other.axis == strip.axis && strip.from_m < other.to_m && other.from_m < strip.to_m) {
        item.Fault("from_m", fmt::format("this strip overlaps the one from {} to {} m",
                                         other.from_m, other.to_m));
      }
    }
    strips.push_back(strip);
  }
  return strips;
}

Relief ReadRelief(const ConfigMap& config, std::uint64_t seed) {
  Relief relief;
  relief.seed = seed;
  if (const auto map = config.OptionalMap("relief")) {
    relief.amplitude_m = map->Number("amplitude_m", Between(0, 10, "m"), 0.0);
    relief.wavelength_m = map->Number("wavelength_m", Between(0.5, 500, "m"), relief.wavelength_m);
    relief.slope_rad = kDeg * map->Number("slope_deg", Between(0, 60, "deg"), 0.0);
    relief.slope_direction_rad = kDeg * map->Number("slope_direction_deg", Any("deg"), 0.0);
  }
  return relief;
}

std::vector<PilePlan> ReadPiles(const ConfigMap& config, SoilCatalogue* soils) {
  std::vector<PilePlan> piles;
  for (const ConfigMap& item : config.List("piles")) {
    PilePlan pile;
    pile.xy_W_m = item.Vector2("xy_m", Any("m"));
    pile.height_m = item.Number("height_m", Between(0, 20, "m"));
    pile.soil = soils->Index(item, "soil", item.Text("soil"));
    piles.push_back(pile);
  }
  return piles;
}

/// The elevation file's grid; one that cannot be used is a fault at its key.
std::optional<ElevationGrid> ReadGeotiff(const ConfigMap& config) {
  const auto file = config.OptionalFile("geotiff");
  if (!file || file->empty()) return std::nullopt;
  try {
    return ReadElevation(*file);
  } catch (const InputError& e) {
    config.Fault("geotiff", e.what());
    return std::nullopt;
  }
}

}  // namespace

SitePlan ReadSite(const ConfigMap& config, std::uint64_t seed) {
  SitePlan plan;
  const auto elevation = ReadGeotiff(config);
  Vec2 size_m(kDefaultSize_m, kDefaultSize_m);
  if (elevation) size_m = Vec2(elevation->width_m(), elevation->depth_m());
  size_m = config.Vector2("size_m", Between(1, 2000, "m"), size_m);
  plan.cell_m = config.Number("cell_m", Between(0.01, 1, "m"), kDefaultCell_m);
  plan.nx = static_cast<int>(std::lround(size_m.x() / plan.cell_m)) + 1;
  plan.ny = static_cast<int>(std::lround(size_m.y() / plan.cell_m)) + 1;
  if (static_cast<double>(plan.nx) * plan.ny > kMostColumns) {
    config.Fault("size_m", fmt::format("{} x {} columns of {} m are more than memory can hold "
                                       "({}); use a larger cell_m or a smaller size_m",
                                       plan.nx, plan.ny, plan.cell_m, kMostColumns));
    plan.nx = plan.ny = 2;
  }
  plan.origin_W_m = -0.5 * plan.cell_m * Vec2(plan.nx - 1, plan.ny - 1);
  if (elevation) plan.georeference = elevation->origin;

  SoilCatalogue soils(config);
  std::uint8_t ground = 0;
  const std::vector<std::string> names = config.Texts("soils");
  for (const std::string& name : names) soils.Index(config, "soils", name);
  if (names.empty() || config.Has("soil")) {
    ground = soils.Index(config, "soil", config.Text("soil", "dirt"));
  }
  const std::vector<Strip> strips = ReadStrips(config, &soils);
  plan.piles = ReadPiles(config, &soils);
  const Relief relief = ReadRelief(config, seed);
  plan.soils = soils.Take();

  const std::size_t n = static_cast<std::size_t>(plan.nx) * plan.ny;
  plan.height_m.resize(n);
  plan.bank_soil.assign(n, ground);
  for (int j = 0; j < plan.ny; ++j) {
    for (int i = 0; i < plan.nx; ++i) {
      const Vec2 p = plan.origin_W_m + plan.cell_m * Vec2(i, j);
      const std::size_t k = static_cast<std::size_t>(j) * plan.nx + i;
      plan.height_m[k] = relief.HeightAt(p.x(), p.y());
      if (elevation) plan.height_m[k] += elevation->HeightAt(p.x(), p.y());
      for (const Strip& strip : strips) {
        if (p[strip.axis] >= strip.from_m && p[strip.axis] < strip.to_m) {
          plan.bank_soil[k] = strip.soil;
        }
      }
    }
  }
  return plan;
}

Columns BuildColumns(const SitePlan& plan) {
  // A scenario with faults has no soil; it is never run.
  std::vector<SoilType> soils = plan.soils;
  if (soils.empty()) soils.emplace_back();
  Columns columns(plan.origin_W_m, plan.cell_m, plan.nx, plan.ny, plan.height_m, plan.bank_soil,
                  std::move(soils));
  for (const PilePlan& pile : plan.piles) {
    const SoilType& soil = columns.soils()[pile.soil];
    const double slope = std::tan(soil.repose_angle_rad);
    const double z_m = columns.HeightAt(pile.xy_W_m.x(), pile.xy_W_m.y()) + pile.height_m;
    // The foot may lie lower than the ground under the top: look as far again.
    const double reach_m = 2 * pile.height_m / slope;
    const int i0 = std::max(0, columns.NearestI(pile.xy_W_m.x() - reach_m));
    const int i1 = std::min(plan.nx - 1, columns.NearestI(pile.xy_W_m.x() + reach_m));
    const int j0 = std::max(0, columns.NearestJ(pile.xy_W_m.y() - reach_m));
    const int j1 = std::min(plan.ny - 1, columns.NearestJ(pile.xy_W_m.y() + reach_m));
    for (int j = j0; j <= j1; ++j) {
      for (int i = i0; i <= i1; ++i) {
        const double r_m = (Vec2(columns.x_m(i), columns.y_m(j)) - pile.xy_W_m).norm();
        const std::size_t k = columns.index(i, j);
        const double thickness_m = z_m - slope * r_m - columns.at(k).top_m();
        if (r_m > reach_m || thickness_m <= 0) continue;
        const double volume_m3 = thickness_m * columns.area_m2();
        columns.Deposit(k, {volume_m3 * LooseDensity_kgpm3(soil), volume_m3, pile.soil});
      }
    }
  }
  return columns;
}

}  // namespace tera
