#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "soil/soil.h"

namespace tera {

/// A plane of a map: a projected reference system in metres.
struct MapReference {
  std::string wkt;       ///< of the plane alone
  std::string name;      ///< for people: "WGS 84 / UTM zone 32N"
  std::string vertical;  ///< zero of the heights, where it was named
  /// Where the plane is meant for, in degrees, where that is known: west, south, east, north.
  std::optional<std::array<double, 4>> area_deg = {};
};

/// The plane of a definition: "EPSG:n" or OGC WKT. Nothing for a local one, which is tied to no
/// place on the earth. `place` is who names it, for messages. Throws InputError for a definition
/// that is not understood, for degrees, and for other units than metres, in heights too.
std::optional<MapReference> ReadMapReference(const std::string& place,
                                             const std::string& definition);

/// The transverse Mercator plane about `origin`, east and north from there, as the ground's rasters
/// have it (ground_raster.h).
MapReference LocalMapReference(const SiteOrigin& origin);

/// Throws InputError if `at_m` lies over 6 degrees outside the area of use of `map`. Maps without a
/// known area pass. `place` names the input in messages.
void RequireOnMap(const std::string& place, const MapReference& map, const Vec2& at_m);

/// Where places of a map lie in W of a site with that origin: east and north, in metres (the plane
/// of ElevationGrid, geotiff.h). Throws InputError where they cannot be converted.
std::vector<Vec2> PlacesInW(const MapReference& map, const SiteOrigin& origin,
                            const std::vector<Vec2>& places_m);

}  // namespace tera
