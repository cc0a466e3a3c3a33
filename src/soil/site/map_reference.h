#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "soil/soil.h"

namespace tera {

/// A projected reference system in metres.
struct MapReference {
  std::string wkt;       ///< without the vertical system
  std::string name;      ///< readable name, for example "WGS 84 / UTM zone 32N"
  std::string vertical;  ///< vertical datum, if the definition names one
  /// Area of use in degrees, if known: west, south, east, north.
  std::optional<std::array<double, 4>> area_deg = {};
};

/// The projected system of a definition: "EPSG:n" or OGC WKT. Empty for a local system, which has
/// no position on the earth. `place` names the input in messages. Throws InputError for an unknown
/// definition, for degrees, and for units other than metres, also of heights.
std::optional<MapReference> ReadMapReference(const std::string& place,
                                             const std::string& definition);

/// Transverse Mercator plane about `origin`, east and north, as in ground_raster.h.
MapReference LocalMapReference(const SiteOrigin& origin);

/// Throws InputError if `at_m` lies over 6 degrees outside the area of use of `map`. Maps without a
/// known area pass. `place` names the input in messages.
void RequireOnMap(const std::string& place, const MapReference& map, const Vec2& at_m);

/// Converts map coordinates to x (east) and y (north) in metres, in the frame W of a site with this
/// origin (the tangent plane of ElevationGrid, geotiff.h). Throws InputError if there is no
/// conversion.
std::vector<Vec2> PlacesInW(const MapReference& map, const SiteOrigin& origin,
                            const std::vector<Vec2>& places_m);

}  // namespace tera
