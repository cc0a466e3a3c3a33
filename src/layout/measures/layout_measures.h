#pragma once

#include <string>
#include <vector>

#include "layout/layout.h"
#include "layout/layout_report.h"
#include "layout/measures/blind_map.h"
#include "layout/measures/coverage.h"
#include "layout/measures/elevation_map.h"
#include "layout/measures/people.h"
#include "layout/measures/shovel_view.h"
#include "layout/study/study.h"
#include "render/scene.h"

namespace tera {

/// Name of the zone around the machine, which every study has.
inline constexpr char kAroundZone[] = "around";

/// A moment of a cycle, as it is looked at.
struct LookedAt {
  const MachineState& machine;  ///< the studied one
  const Sighting& sighting;     ///< which shows that moment
  const TerrainSurface& ground;
};

/// What is to be looked at in a moment: the same for all layouts.
struct Places {
  Pose X_WH = Pose::Identity();  ///< as in PolarGrid
  std::vector<double> hull_m;    ///< HullRadii_m
  std::vector<std::vector<Vec3>> zones_W_m;
  std::vector<PolarPlaces> maps;  ///< of each height
};

/// All that a study asks of one layout, moment by moment.
class LayoutMeasures {
 public:
  /// `wanted` says which figures are wanted, by the beginning of their names ("zone/behind");
  /// empty: all. Keeps references to all but `wanted`.
  LayoutMeasures(const LayoutStudy& study, const MachinePlacement& placement,
                 const StudiedMachine& studied, const SceneModel& scene,
                 const std::vector<std::string>& wanted = {});

  Places PlacesOf(const LookedAt& moment) const;
  /// Adds what `layout` sees now, whose viewers stand where they are.
  void Add(const LookedAt& moment, const Places& places, const Layout& layout);
  std::vector<Figure> Figures() const;
  /// Figures, maps, curves, causes and overlaps.
  void Report(LayoutReport* report) const;

 private:
  const LayoutStudy& study_;
  const MachineModel& model_;
  StudiedMachine studied_;
  std::vector<ZoneCoverage> zones_;
  std::vector<BlindMap> maps_;
  std::vector<PersonRange> people_;
  std::vector<ShovelView> shovels_;
  std::vector<ElevationMap> elevation_;  ///< one, or none where it is not wanted
};

}  // namespace tera
