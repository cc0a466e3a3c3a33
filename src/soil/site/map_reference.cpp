#include "soil/site/map_reference.h"

#include <fmt/format.h>

#include <memory>

#include "core/error.h"
#include "soil/site/georaster.h"

namespace tera {
namespace {

OGRSpatialReference Parse(const std::string& place, const std::string& definition) {
  OGRSpatialReference system;
  // The definition is never read as a file name or URL.
  if (definition.empty() ||
      system.SetFromUserInput(definition.c_str(),
                              OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get()) !=
          OGRERR_NONE) {
    throw InputError(
        place, {FaultKind::kMalformed,
                fmt::format("reference system '{:.60}' is not understood; need EPSG:n or OGC WKT",
                            definition)});
  }
  system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return system;
}

/// Removes the vertical system and returns its name.
std::string TakeVertical(const std::string& place, OGRSpatialReference* system) {
  const char* name = system->GetAttrValue("VERT_CS");
  if (!name) return "";
  const std::string vertical = name;
  if (system->GetTargetLinearUnits("VERT_CS") != 1.0) {
    throw InputError(
        place,
        fmt::format(
            "heights of '{}' are not in metres; convert them first, e.g. with pdal or gdalwarp",
            vertical));
  }
  system->StripVertical();
  return vertical;
}

}  // namespace

std::optional<MapReference> ReadMapReference(const std::string& place,
                                             const std::string& definition) {
  const QuietGdal quiet;
  OGRSpatialReference system = Parse(place, definition);
  if (system.IsLocal()) return std::nullopt;
  MapReference map;
  map.vertical = TakeVertical(place, &system);
  map.name = system.GetName() ? system.GetName() : "unnamed";
  if (!system.IsProjected()) {
    throw InputError(place, fmt::format("'{}' is in degrees or no map's plane; reproject it to a "
                                        "projected system in metres, e.g. with gdalwarp or pdal",
                                        map.name));
  }
  if (system.GetLinearUnits() != 1.0) {
    throw InputError(
        place, fmt::format(
                   "'{}' has a unit of {} m, need metres; reproject it, e.g. with gdalwarp or pdal",
                   map.name, system.GetLinearUnits()));
  }
  std::array<double, 4> area_deg{};
  if (system.GetAreaOfUse(&area_deg[0], &area_deg[1], &area_deg[2], &area_deg[3], nullptr)) {
    map.area_deg = area_deg;
  }
  map.wkt = WktOf(system);
  return map;
}

void RequireOnMap(const std::string& place, const MapReference& map, const Vec2& at_m) {
  constexpr double kMargin_deg = 6;  // the plane of a zone is usable a little beyond it
  if (!map.area_deg) return;
  const auto [west, south, east, north] = *map.area_deg;
  if (west > east) return;  // across the date line
  const QuietGdal quiet;
  double lon_deg = at_m.x(), lat_deg = at_m.y();
  OGRSpatialReference geographic;
  geographic.SetWellKnownGeogCS("WGS84");
  geographic.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const OGRSpatialReference plane = Parse(map.name, map.wkt);
  const std::unique_ptr<OGRCoordinateTransformation> conversion(
      OGRCreateCoordinateTransformation(&plane, &geographic));
  const bool is_converted = conversion && conversion->Transform(1, &lon_deg, &lat_deg);
  if (is_converted && lon_deg > west - kMargin_deg && lon_deg < east + kMargin_deg &&
      lat_deg > south - kMargin_deg && lat_deg < north + kMargin_deg) {
    return;
  }
  throw InputError(
      place,
      fmt::format(
          "x {:.0f} m, y {:.0f} m lie {} in '{}', which is for {:.0f} to {:.0f} deg N, {:.0f} to "
          "{:.0f} deg E; need the map of these coordinates, in metres, x east and y north",
          at_m.x(), at_m.y(),
          is_converted ? fmt::format("at {:.2f} deg N, {:.2f} deg E", lat_deg, lon_deg) : "nowhere",
          map.name, south, north, west, east));
}

MapReference LocalMapReference(const SiteOrigin& origin) {
  const QuietGdal quiet;
  return {WktOf(SitePlane(origin)), "site plane", ""};
}

std::vector<Vec2> PlacesInW(const MapReference& map, const SiteOrigin& origin,
                            const std::vector<Vec2>& places_m) {
  const QuietGdal quiet;
  std::vector<double> x, y;
  for (const Vec2& place : places_m) {
    x.push_back(place.x());
    y.push_back(place.y());
  }
  if (places_m.empty()) return {};
  Conversion(map.name, Parse(map.name, map.wkt), SitePlane(origin)).Apply(&x, &y);
  std::vector<Vec2> converted;
  for (std::size_t k = 0; k < x.size(); ++k) converted.emplace_back(x[k], y[k]);
  return converted;
}

}  // namespace tera
