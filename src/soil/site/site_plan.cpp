#include "soil/site/site_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/error.h"
#include "core/units.h"
#include "soil/columns/soil_type.h"
#include "soil/site/geotiff.h"
#include "soil/site/read_profiles.h"
#include "soil/site/relief.h"
#include "soil/site/seepage.h"
#include "soil/site/soil_catalogue.h"

namespace tera {
namespace {

constexpr double kDefaultSize_m = 40, kDefaultCell_m = 0.05;
constexpr double kMostColumns = 4e8;
/// greatest spacing of undisturbed heights on uneven ground
constexpr double kRoughestBase_m = 0.5;
constexpr double kMostBaseVertices = 2.6e7;
constexpr double kBasePerWavelength = 16;  ///< four for the shortest octave

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

std::vector<PilePlan> ReadPiles(const ConfigMap& config, const TerrainGrid& grid,
                                SoilCatalogue* soils) {
  const Vec2 low_m = grid.origin_W_m, high_m(grid.x_m(grid.nx - 1), grid.y_m(grid.ny - 1));
  std::vector<PilePlan> piles;
  for (const ConfigMap& item : config.List("piles")) {
    PilePlan pile;
    const auto place = [&](const char* key) {
      const Vec2 p_m = item.Vector2(key, Any("m"));
      if ((p_m.array() < low_m.array()).any() || (p_m.array() > high_m.array()).any()) {
        item.Fault(key, {FaultKind::kOutOfRange,
                         fmt::format("lies beyond the site, x {:g} to {:g} m, y {:g} to {:g} m",
                                     low_m.x(), high_m.x(), low_m.y(), high_m.y())});
      }
      return p_m;
    };
    pile.xy_W_m = pile.end_W_m = place("xy_m");
    if (item.Has("to_m")) pile.end_W_m = place("to_m");
    pile.height_m = item.Number("height_m", Between(0, 20, "m"));
    pile.soil = soils->Index(item, "soil", item.Text("soil"));
    piles.push_back(pile);
  }
  return piles;
}

/// Reads the elevation file. An unusable file is a fault of its key.
std::optional<ElevationGrid> ReadGeotiff(const ConfigMap& config) {
  const auto file = config.OptionalFile("geotiff");
  if (!file || file->empty()) return std::nullopt;
  try {
    const ElevationGrid grid = ReadElevation(*file);
    for (const std::filesystem::path& read : grid.files) config.AlsoReads(read);
    return grid;
  } catch (const InputError& e) {
    config.Fault("geotiff", e.faults().front());
    return std::nullopt;
  }
}

/// Converts given heights to the form of an elevation file.
ElevationGrid GridOf(const GivenGround& given) {
  ElevationGrid grid;
  grid.nx = given.nx;
  grid.ny = given.ny;
  grid.cell_x_m = grid.cell_y_m = given.cell_m;
  grid.height_m = given.height_m;
  return grid;
}

/// Largest divisor of the tile size, in cells, with a spacing of at most `spacing_m`. It is larger
/// if there would be too many vertices.
int BaseCells(double spacing_m, const TerrainGrid& grid) {
  int best = 1;
  for (int n = 1; n <= TerrainGrid::kTileCells; ++n) {
    if (TerrainGrid::kTileCells % n != 0) continue;
    const double vertices = static_cast<double>(grid.nx) / best * grid.ny / best;
    if (n * grid.cell_m <= spacing_m * (1 + 1e-9) || vertices > kMostBaseVertices) {
      best = n;
    }
  }
  return best;
}

/// Reads the soil map onto a grid about `origin`, or about the middle of the file without one.
std::optional<SoilClassGrid> ReadClassFile(const ConfigMap& config,
                                           const std::optional<SiteOrigin>& origin) {
  const auto map = config.OptionalMap("soil_classes");
  if (!map) return std::nullopt;
  const std::filesystem::path file = map->File("geotiff");
  if (file.empty()) return std::nullopt;
  try {
    SoilClassGrid classes = ReadSoilClasses(file, origin);
    for (const std::filesystem::path& read : classes.files) map->AlsoReads(read);
    return classes;
  } catch (const InputError& e) {
    map->Fault("geotiff", e.faults().front());
    return std::nullopt;
  }
}

/// Requires that the soil map covers the site. The tolerance allows for corners that rotation by
/// the meridian convergence leaves out.
void RequireCover(const ConfigMap& config, const SoilClassGrid& classes, const TerrainGrid& grid) {
  constexpr double kSpare = 0.05;  // share of the size of the map: three degrees
  const Vec2 size_m = classes.cell_m.cwiseProduct(Vec2(classes.nx, classes.ny));
  const Vec2 low_m = classes.first_m - 0.5 * classes.cell_m, high_m = low_m + size_m;
  const Vec2 site_high_m(grid.x_m(grid.nx - 1), grid.y_m(grid.ny - 1));
  const bool covers = (grid.origin_W_m.array() >= (low_m - kSpare * size_m).array()).all() &&
                      (site_high_m.array() <= (high_m + kSpare * size_m).array()).all();
  if (covers) return;
  config.Map("soil_classes")
      .Fault("geotiff",
             fmt::format("reaches from x {:.1f} to {:.1f} m, y {:.1f} to {:.1f} m of the site, "
                         "which goes from x {:.1f} to {:.1f} m, y {:.1f} to {:.1f} m; need a "
                         "class for all of it",
                         low_m.x(), high_m.x(), low_m.y(), high_m.y(), grid.origin_W_m.x(),
                         site_high_m.x(), grid.origin_W_m.y(), site_high_m.y()));
}

/// Profiles from a soil map. A value that is not among the scenario's classes is a fault.
ProfileMap MapOf(const ConfigMap& config, const SoilClassGrid& classes,
                 const std::map<std::uint8_t, std::uint8_t>& profile_of_class) {
  ProfileMap map{classes.nx, classes.ny, classes.first_m, classes.cell_m, {}};
  std::map<std::uint8_t, std::int64_t> unknown;
  for (const std::uint8_t value : classes.value) {
    const auto known = profile_of_class.find(value);
    if (known == profile_of_class.end()) ++unknown[value];
    map.profile.push_back(known == profile_of_class.end() ? 0 : known->second);
  }
  for (const auto& [value, count] : unknown) {
    const bool is_gap = classes.gap_value == value;
    config.Map("soil_classes")
        .Fault("geotiff",
               fmt::format("{} of {} pixels have {} {}; {}", count, classes.value.size(),
                           is_gap ? "no class: the file's no-data value" : "the value", value,
                           is_gap ? "fill the gaps, or name its soil under classes"
                                  : "name its soil under classes"));
  }
  return map;
}

TerrainGrid ReadGrid(const ConfigMap& config, const std::optional<ElevationGrid>& elevation,
                     const std::optional<SoilClassGrid>& classes) {
  TerrainGrid grid;
  Vec2 size_m(kDefaultSize_m, kDefaultSize_m);
  if (classes) size_m = classes->cell_m.cwiseProduct(Vec2(classes->nx - 1, classes->ny - 1));
  if (elevation) size_m = Vec2(elevation->width_m(), elevation->depth_m());
  size_m = config.Vector2("size_m", Between(1, 2000, "m"), size_m);
  grid.cell_m = config.Number("cell_m", Between(0.01, 1, "m"), kDefaultCell_m);
  grid.nx = static_cast<int>(std::lround(size_m.x() / grid.cell_m)) + 1;
  grid.ny = static_cast<int>(std::lround(size_m.y() / grid.cell_m)) + 1;
  if (static_cast<double>(grid.nx) * grid.ny > kMostColumns) {
    config.Fault("size_m", {FaultKind::kOutOfRange,
                            fmt::format("{} x {} columns of {} m are more than the {} that a site "
                                        "can have; use a larger cell_m or a smaller size_m",
                                        grid.nx, grid.ny, grid.cell_m, kMostColumns)});
    grid.nx = grid.ny = 2;
  }
  grid.origin_W_m = -0.5 * grid.cell_m * Vec2(grid.nx - 1, grid.ny - 1);
  return grid;
}

/// The point on the crest of a pile that is nearest to `p_m`.
Vec2 NearestOfCrest(const PilePlan& pile, const Vec2& p_m) {
  const Vec2 along_m = pile.end_W_m - pile.xy_W_m;
  const double squared = along_m.squaredNorm();
  if (squared == 0) return pile.xy_W_m;
  return pile.xy_W_m + std::clamp((p_m - pile.xy_W_m).dot(along_m) / squared, 0.0, 1.0) * along_m;
}

/// Adds a pile: its crest is `height_m` above the ground, its sides are at repose.
void Heap(const PilePlan& pile, Columns* columns) {
  const SoilType& soil = columns->soils()[pile.soil];
  const double slope = std::tan(soil.repose_angle_rad);
  const auto crest_m = [&](const Vec2& p_m) {
    return columns->HeightAt(p_m.x(), p_m.y()) + pile.height_m;
  };
  const bool is_cone = pile.xy_W_m == pile.end_W_m;
  const double top_m = crest_m(pile.xy_W_m);
  // The foot may lie lower than the ground under the top, hence twice the distance.
  const double reach_m = 2 * pile.height_m / slope;
  const Vec2 low_m = pile.xy_W_m.cwiseMin(pile.end_W_m),
             high_m = pile.xy_W_m.cwiseMax(pile.end_W_m);
  const int i0 = std::max(0, columns->NearestI(low_m.x() - reach_m));
  const int i1 = std::min(columns->nx() - 1, columns->NearestI(high_m.x() + reach_m));
  const int j0 = std::max(0, columns->NearestJ(low_m.y() - reach_m));
  const int j1 = std::min(columns->ny() - 1, columns->NearestJ(high_m.y() + reach_m));
  struct Rise {
    int i, j;
    double thickness_m;
  };
  // all thicknesses are computed before any deposit, because the crest refers to the ground below
  std::vector<Rise> rises;
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      const Vec2 p_m(columns->x_m(i), columns->y_m(j));
      const Vec2 crest = NearestOfCrest(pile, p_m);
      const double r_m = (p_m - crest).norm();
      const double z_m = is_cone ? top_m : crest_m(crest);
      const double thickness_m = z_m - slope * r_m - columns->TopAt(i, j);
      if (r_m <= reach_m && thickness_m > 0) rises.push_back({i, j, thickness_m});
    }
  }
  for (const Rise& rise : rises) {
    const double volume_m3 = rise.thickness_m * columns->area_m2();
    columns->Deposit(columns->Touch(rise.i, rise.j),
                     Spoil{volume_m3 * LooseDensity_kgpm3(soil), volume_m3, pile.soil,
                           static_cast<float>(soil.moisture)});
  }
}

/// Applies weather to the ground. A pile gets the moisture of a deep layer of its soil.
void LetItRain(const ConfigMap& config, const std::vector<WeatherSpell>& weather, SitePlan* plan) {
  constexpr double kBottom_m = std::numeric_limits<double>::infinity();
  std::vector<GroundProfile> profiles = plan->ground.profiles;
  for (const PilePlan& pile : plan->piles) {
    const SoilType& soil = plan->kinds.soils()[pile.soil];
    profiles.push_back(GroundProfile(
        {{kBottom_m, pile.soil, static_cast<float>(soil.moisture), LooseDensity_kgpm3(soil)}}));
  }
  if (!Wet(weather, &plan->kinds, &profiles)) {
    config.Fault("weather_before",
                 {FaultKind::kOutOfRange,
                  "makes more than 255 kinds of soil of different moisture; need fewer soils or "
                  "strata, or no weather before"});
    return;
  }
  const auto piles = profiles.begin() + static_cast<std::ptrdiff_t>(plan->ground.profiles.size());
  for (std::size_t n = 0; n < plan->piles.size(); ++n) {
    plan->piles[n].soil = (piles + static_cast<std::ptrdiff_t>(n))->strata().front().soil;
  }
  plan->ground.profiles.assign(profiles.begin(), piles);
}

}  // namespace

SitePlan ReadSite(const ConfigMap& config, std::uint64_t seed,
                  const std::optional<GivenGround>& given) {
  SitePlan plan;
  auto elevation = ReadGeotiff(config);
  if (elevation) plan.georeference = elevation->origin;
  if (elevation && given) {
    config.Fault("geotiff", "the ground is that of environment.mesh too; need one of the two");
  }
  if (given) elevation = GridOf(*given);
  const auto classes = ReadClassFile(config, plan.georeference);
  if (classes && !elevation) plan.georeference = classes->origin;
  UndisturbedGround& ground = plan.ground;
  ground.grid = ReadGrid(config, elevation, classes);
  SoilCatalogue soils(config);
  SiteProfiles profiles = ReadProfiles(config, &soils);
  ground.profiles = std::move(profiles.profiles);
  ground.regions = std::move(profiles.regions);
  if (classes) {
    RequireCover(config, *classes, ground.grid);
    ground.map = MapOf(config, *classes, profiles.profile_of_class);
  }
  plan.piles = ReadPiles(config, ground.grid, &soils);
  plan.pits = ReadPits(config, ground.grid);
  plan.ruts = ReadRuts(config);
  plan.kinds = SoilKinds(soils.soils());
  if (const auto weather = ReadWeatherBefore(config); !weather.empty() && !soils.soils().empty()) {
    plan.has_weather_before = true;
    LetItRain(config, weather, &plan);
  }

  const Relief relief = ReadRelief(config, seed);
  // planes need no smaller spacing
  double spacing_m = TerrainGrid::kTileCells * ground.grid.cell_m;
  if (relief.amplitude_m > 0) {
    spacing_m = std::min({spacing_m, kRoughestBase_m, relief.wavelength_m / kBasePerWavelength});
  }
  if (elevation) {
    spacing_m = std::min(
        {spacing_m, kRoughestBase_m, 0.5 * std::min(elevation->cell_x_m, elevation->cell_y_m)});
  }
  ground.base_cells = BaseCells(spacing_m, ground.grid);
  for (int b = 0; b < ground.base_ny(); ++b) {
    const double y_m = ground.grid.y_m(BaseVertex(b, ground.grid.ny, ground.base_cells));
    for (int a = 0; a < ground.base_nx(); ++a) {
      const double x_m = ground.grid.x_m(BaseVertex(a, ground.grid.nx, ground.base_cells));
      double z_m = relief.HeightAt(x_m, y_m);
      if (elevation) z_m += elevation->HeightAt(x_m, y_m);
      ground.base_height_m.push_back(z_m);
    }
  }
  return plan;
}

Columns BuildColumns(const SitePlan& plan) {
  // A faulty scenario has no soil; it never runs.
  Columns columns(plan.ground, plan.kinds.soils().empty() ? SoilKinds({SoilType()}) : plan.kinds);
  for (const RutPlan& ruts : plan.ruts) Press(ruts, &columns);
  for (const PitPlan& pit : plan.pits) Dig(pit, &columns);
  for (const PilePlan& pile : plan.piles) Heap(pile, &columns);
  columns.MarkStart();
  return columns;
}

}  // namespace tera
