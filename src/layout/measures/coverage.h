#pragma once

#include <map>
#include <string>
#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/measures/seen.h"
#include "layout/study/study.h"

namespace tera {

/// Coverage of a zone by a layout, moment by moment.
///
/// Model   counts the zone's places that lie in the air over the site (above its ground, in nothing
///         solid). The figures are the shares that at least 1, 2, 3 viewers see, and the unseen
///         volume. Places off the site do not count.
/// Omits   the difference from the share of the zone's whole air beyond the standard error.
class ZoneCoverage {
 public:
  /// `count` places of the zone, the same at every moment in its frame.
  ZoneCoverage(Zone zone, int count, std::uint64_t seed);

  const Zone& zone() const { return zone_; }
  /// The zone's places in the air over the site at this moment, with the zone's frame F at X_WF.
  /// They are the same for all layouts.
  std::vector<Vec3> PlacesInAir(const Pose& X_WF, const Sighting& sighting,
                                const TerrainSurface& ground) const;
  /// Adds the view of `layout` on these places.
  void Add(const std::vector<Vec3>& in_air_W_m, const Layout& layout, const SeenFrom& seen,
           const Sighting& sighting);

  /// Whether any place lay in the air at any moment.
  bool HadPlaces() const;
  /// Figures of the zone.
  std::vector<Figure> Figures() const;
  /// Causes of the blind places: shares over all moments that sum to 1. A cause is the name of the
  /// occluding part, "out of view", or "too far or too sparse".
  std::map<std::string, double> Causes() const;
  /// For each pair of viewers: the places that both see, as a share of those that either sees.
  /// Extrinsic calibration of the two needs overlap.
  std::map<std::string, double> Overlaps() const;
  /// The places in a viewer's field and reach with enough density, over all moments. Seen places,
  /// and hidden places by the name of the occluding part.
  struct FieldOf {
    double seen = 0, hidden = 0;
    std::map<std::string, double> hidden_by = {};

    double SeenShare() const { return seen + hidden > 0 ? seen / (seen + hidden) : 0; }
  };
  /// By the viewers' names.
  const std::map<std::string, FieldOf>& Fields() const { return fields_; }

 private:
  static constexpr int kMost = 3;
  struct Pair {
    double both = 0, either = 0;
  };
  void CountCauses(const std::vector<Look>& looks, const Sighting& sighting);
  void CountFields(const std::vector<Look>& looks, const Layout& layout, const Sighting& sighting);
  void CountPairs(const std::vector<Look>& looks, const Layout& layout);

  Zone zone_;
  std::vector<Vec3> places_Z_m_;
  std::vector<std::vector<double>> share_;  ///< seen by at least 1, 2, 3; one per moment
  std::vector<std::size_t> in_air_;         ///< one per moment
  std::vector<double> blind_m3_;
  std::map<std::string, double> causes_;
  std::map<std::string, Pair> pairs_;
  std::map<std::string, FieldOf> fields_;
};

}  // namespace tera
