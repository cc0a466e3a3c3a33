#pragma once

#include <map>
#include <string>
#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/measures/seen.h"
#include "layout/study/study.h"

namespace tera {

/// Coverage of a zone by a layout at each moment.
///
/// Model   counts those sample places of the zone that lie over the site, above the ground and
///         outside solid objects. The figures are the shares of these places that at least 1, 2 and
///         3 viewers see, and the unseen volume.
/// Omits   errors of the share beyond the standard error of sampling.
class ZoneCoverage {
 public:
  /// Samples about `count` places. They are fixed in the zone's frame.
  ZoneCoverage(Zone zone, int count, std::uint64_t seed);

  const Zone& zone() const { return zone_; }
  /// The zone's places that lie in the air over the site at this moment. X_WF is the pose of the
  /// zone's frame F. The places are the same for all layouts.
  std::vector<Vec3> PlacesInAir(const Pose& X_WF, const Sighting& sighting,
                                const TerrainSurface& ground) const;
  /// Adds a moment: the views of `layout` on these places.
  void Add(const std::vector<Vec3>& in_air_W_m, const Layout& layout, const SeenFrom& seen,
           const Sighting& sighting);

  /// Whether any place lay in the air at any moment.
  bool HadPlaces() const;
  std::vector<Figure> Figures() const;
  /// Causes of blind places, as shares over all moments that sum to 1. A cause is the name of the
  /// occluding part, "out of view", or "too far or too sparse".
  std::map<std::string, double> Causes() const;
  /// For each pair of viewers: the places that both see, as a share of the places that either sees.
  /// Extrinsic calibration of a pair needs overlap.
  std::map<std::string, double> Overlaps() const;
  /// Occlusion of one viewer: places within its field of view, range and density, over all moments.
  /// They are either seen or hidden; hidden places are listed by occluding part.
  struct FieldOf {
    double seen = 0, hidden = 0;
    std::map<std::string, double> hidden_by = {};

    double SeenShare() const { return seen + hidden > 0 ? seen / (seen + hidden) : 0; }
  };
  /// One entry per viewer, by name.
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
  /// [n - 1][moment]: share of places that at least n = 1, 2, 3 viewers see.
  std::vector<std::vector<double>> share_;
  /// Number of places in the air, one per moment.
  std::vector<std::size_t> in_air_;
  std::vector<double> blind_m3_;
  std::map<std::string, double> causes_;
  std::map<std::string, Pair> pairs_;
  std::map<std::string, FieldOf> fields_;
};

}  // namespace tera
