#pragma once

#include <map>
#include <string>
#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/measures/seen.h"
#include "layout/study/study.h"

namespace tera {

/// How much of a zone a layout sees, moment by moment.
///
/// Model   places of the zone that lie in the air over the site (above its ground, in nothing
///         solid) count; the share of them that at least 1, 2, 3 viewers see, and the volume that
///         none does. Of what lies beyond the site nothing is asked.
/// Omits   how the share differs from that of all the zone's air, beyond its standard error.
class ZoneCoverage {
 public:
  /// `count` places of the zone, the same at every moment in its frame.
  ZoneCoverage(Zone zone, int count, std::uint64_t seed);

  const Zone& zone() const { return zone_; }
  /// Its places that lie in the air over the site at this moment, the zone's frame F being at X_WF:
  /// the same for all layouts.
  std::vector<Vec3> PlacesInAir(const Pose& X_WF, const Sighting& sighting,
                                const TerrainSurface& ground) const;
  /// Adds what `layout` sees of these.
  void Add(const std::vector<Vec3>& in_air_W_m, const Layout& layout, const SeenFrom& seen,
           const Sighting& sighting);

  /// Whether any place lay in the air at any moment.
  bool HadPlaces() const;
  /// Measures of the zone.
  std::vector<Figure> Figures() const;
  /// What keeps places from being seen: shares of the blind places of all moments, by the name of
  /// what blocks, or "out of view" or "too far or too sparse"; together 1.
  std::map<std::string, double> Causes() const;
  /// Of places seen by two viewers or more: the share of the places that either sees, for each
  /// pair. Overlap is what extrinsic calibration of one beside the other lives on.
  std::map<std::string, double> Overlaps() const;
  /// Of one viewer the places that lie in its field, in its reach and densely enough, over all
  /// moments: those that it sees, and those that something hides, by the name of that.
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
  std::vector<std::vector<double>> share_;  ///< seen by at least 1, 2, 3; of each moment
  std::vector<std::size_t> in_air_;         ///< of each moment
  std::vector<double> blind_m3_;
  std::map<std::string, double> causes_;
  std::map<std::string, Pair> pairs_;
  std::map<std::string, FieldOf> fields_;
};

}  // namespace tera
