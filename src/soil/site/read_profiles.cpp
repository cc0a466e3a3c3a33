#include "soil/site/read_profiles.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "soil/columns/soil_type.h"
#include "soil/site/outline.h"

namespace tera {
namespace {

constexpr double kBeyond_m = 1e5;  ///< strips extend this far along their length

Stratum StratumOf(std::uint8_t soil, const SoilCatalogue& soils) {
  if (soils.soils().empty()) return {std::numeric_limits<double>::infinity(), soil, 0, 0};
  const SoilType& type = soils.soils()[soil];
  return {std::numeric_limits<double>::infinity(), soil, static_cast<float>(type.moisture),
          type.bank_density_kgpm3};
}

/// Reads the bulk density of a layer, which must be in the range of its soil.
double ReadDensity(const ConfigMap& layer, const SoilCatalogue& soils, const Stratum& stratum) {
  const double density_kgpm3 =
      layer.Number("density_kgpm3", Between(500, 4000, "kg/m^3"), stratum.density_kgpm3);
  if (soils.soils().empty()) return density_kgpm3;
  const SoilType& soil = soils.soils()[stratum.soil];
  if (density_kgpm3 < LooseDensity_kgpm3(soil) || density_kgpm3 > soil.max_density_kgpm3) {
    layer.Fault(
        "density_kgpm3",
        {FaultKind::kOutOfRange,
         fmt::format("{} is not a density of {}, need {:.0f} (dug) to {:.0f} (compacted) "
                     "kg/m^3",
                     density_kgpm3, soil.name, LooseDensity_kgpm3(soil), soil.max_density_kgpm3)});
  }
  return density_kgpm3;
}

/// Reads layers from the surface down, without gap or overlap. The last layer has no lower end.
GroundProfile ReadLayers(const ConfigMap& config, SoilCatalogue* soils) {
  std::vector<Stratum> strata;
  double bottom_m = 0;
  const std::vector<ConfigMap> items = config.List("layers");
  if (items.empty()) {
    config.Fault("layers", "an empty list; name at least one layer");
    return GroundProfile({StratumOf(0, *soils)});
  }
  for (std::size_t n = 0; n < items.size(); ++n) {
    const ConfigMap& item = items[n];
    Stratum stratum = StratumOf(soils->Index(item, "soil", item.Text("soil")), *soils);
    const double from_m = item.Number("from_m", AtLeast(0, "m"));
    if (from_m < bottom_m) {
      item.Fault("from_m", fmt::format("this layer overlaps the one above it, which ends at {} m; "
                                       "begin it there",
                                       bottom_m));
    } else if (from_m > bottom_m) {
      item.Fault("from_m", fmt::format("no layer from {} to {} m of depth; begin it at {}",
                                       bottom_m, from_m, bottom_m));
    }
    const bool last = n + 1 == items.size();
    if (!last) {
      stratum.bottom_m = item.Number("to_m", Positive("m"));
      if (stratum.bottom_m <= from_m) {
        item.Fault("to_m", fmt::format("{} is not below from_m {}", stratum.bottom_m, from_m));
      }
    } else if (item.Has("to_m")) {
      item.Fault("to_m", "the lowest layer goes on without end; leave to_m out");
    }
    stratum.density_kgpm3 = ReadDensity(item, *soils, stratum);
    stratum.moisture =
        static_cast<float>(item.Number("moisture", Between(0, 1, "(degree of saturation)"),
                                       static_cast<double>(stratum.moisture)));
    bottom_m = stratum.bottom_m;
    strata.push_back(stratum);
  }
  return GroundProfile(strata);
}

/// Reads `soil` or `layers`, which exclude each other.
GroundProfile ReadProfile(const ConfigMap& config, SoilCatalogue* soils) {
  if (config.Has("layers")) {
    if (config.Has("soil"))
      config.Fault("soil", "soil and layers exclude each other; leave one out");
    return ReadLayers(config, soils);
  }
  return GroundProfile({StratumOf(soils->Index(config, "soil", config.Text("soil")), *soils)});
}

void ReadStrips(const ConfigMap& config, SoilCatalogue* soils, SiteProfiles* site) {
  struct Strip {
    int axis;
    double from_m, to_m;
  };
  std::vector<Strip> strips;
  for (const ConfigMap& item : config.List("strips")) {
    Strip strip;
    strip.axis = item.Choice("axis", {"x", "y"}, "x") == "x" ? 0 : 1;
    strip.from_m = item.Number("from_m", Any("m"));
    strip.to_m = item.Number("to_m", Any("m"));
    site->profiles.push_back(ReadProfile(item, soils));
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
    const Vec2 along = Vec2::Unit(strip.axis), across = Vec2::Unit(1 - strip.axis);
    const Vec2 from = strip.from_m * along, to = strip.to_m * along, far = kBeyond_m * across;
    site->regions.push_back({{from - far, to - far, to + far, from + far},
                             static_cast<std::uint8_t>(site->profiles.size() - 1)});
  }
}

void ReadRegions(const ConfigMap& config, SoilCatalogue* soils, SiteProfiles* site) {
  for (const ConfigMap& item : config.List("regions")) {
    ProfileRegion region;
    region.outline_W_m = ReadOutline(item);
    site->profiles.push_back(ReadProfile(item, soils));
    region.profile = static_cast<std::uint8_t>(site->profiles.size() - 1);
    if (!region.outline_W_m.empty()) site->regions.push_back(region);
  }
}

/// Reads the classes of a soil map, each with `soil` or `layers`.
void ReadClasses(const ConfigMap& config, SoilCatalogue* soils, SiteProfiles* site) {
  for (const char* key : {"soil", "layers"}) {
    if (!config.Has(key)) continue;
    config.Fault(key, fmt::format("{} and soil_classes exclude each other; leave one out", key));
  }
  const ConfigMap map = config.Map("soil_classes");
  for (const ConfigMap& item : map.List("classes")) {
    const auto value = static_cast<std::uint8_t>(item.Integer("value", Between(0, 255, "")));
    site->profiles.push_back(ReadProfile(item, soils));
    const auto profile = static_cast<std::uint8_t>(site->profiles.size() - 1);
    if (!site->profile_of_class.emplace(value, profile).second) {
      item.Fault("value", {FaultKind::kRepeated, fmt::format("second class of value {}", value)});
    }
  }
  if (site->profiles.empty()) {
    map.Fault("classes", {FaultKind::kNoSuchName,
                          "names no class; need {value, soil} for each value of the file"});
    site->profiles.push_back(GroundProfile({StratumOf(0, *soils)}));
  }
}

}  // namespace

SiteProfiles ReadProfiles(const ConfigMap& config, SoilCatalogue* soils) {
  SiteProfiles site;
  const std::vector<std::string> names = config.Texts("soils");
  for (const std::string& name : names) soils->Index(config, "soils", name);
  if (config.Has("soil_classes")) {
    ReadClasses(config, soils, &site);
  } else if (config.Has("layers") || config.Has("soil")) {
    site.profiles.push_back(ReadProfile(config, soils));
  } else {
    const std::string name = names.empty() ? config.Text("soil", "dirt") : names.front();
    site.profiles.push_back(GroundProfile({StratumOf(soils->Index(config, "soil", name), *soils)}));
  }
  ReadStrips(config, soils, &site);
  ReadRegions(config, soils, &site);
  constexpr std::size_t kMostProfiles = 256;
  if (site.profiles.size() > kMostProfiles) {
    config.Fault("regions", {FaultKind::kOutOfRange,
                             fmt::format("{} strips, regions and classes of soil, with at most {} "
                                         "possible",
                                         site.profiles.size() - 1, kMostProfiles - 1)});
    site.regions.clear();
  }
  return site;
}

}  // namespace tera
