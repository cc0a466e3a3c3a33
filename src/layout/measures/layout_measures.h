#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "layout/layout.h"
#include "layout/layout_report.h"
#include "layout/measures/blind_map.h"
#include "layout/measures/coverage.h"
#include "layout/measures/elevation_map.h"
#include "layout/measures/occupancy_entropy.h"
#include "layout/measures/people.h"
#include "layout/measures/perception_entropy.h"
#include "layout/measures/pixel_density.h"
#include "layout/measures/shovel_view.h"
#include "layout/measures/sky_view.h"
#include "layout/sight/mount_check.h"
#include "layout/study/study.h"
#include "sim/scene_assembly.h"

namespace tera {

/// The world at one moment of a cycle.
struct LookedAt {
  const Instant& now;
  const Sighting& sighting;  ///< shows the scene at that moment
  const TerrainSurface& ground;
};

/// The test places at one moment, the same for all layouts.
struct Places {
  Pose X_WH = Pose::Identity();  ///< as in PolarGrid
  std::vector<double> hull_m;    ///< HullRadii_m
  std::vector<std::vector<Vec3>> zones_W_m;
  std::vector<PolarPlaces> maps;  ///< one per height of a map
  PolarPlaces pixels;
  std::vector<Occupant> occupants;
};

/// The figures to compute. Empty: all.
using WantedFigures = std::optional<std::vector<FigureId>>;

/// All measures of a study for one layout. Moments are added one by one.
class LayoutMeasures {
 public:
  /// Keeps references to all arguments except `layout` and `wanted`.
  LayoutMeasures(const LayoutStudy& study, const Scenario& scenario, const SceneAssembly& assembly,
                 const Layout& layout, const WantedFigures& wanted = std::nullopt);

  Places PlacesOf(const LookedAt& moment) const;
  /// Adds a moment. The viewers of `layout` must have their current poses.
  void Add(const LookedAt& moment, const Places& places, const Layout& layout);
  /// Looks for viewers that are mounted inside the machine at this moment.
  void CheckMounts(const LookedAt& moment, const Layout& layout);
  /// Warnings for viewers inside the machine, and for viewers with less than 1 % of their field
  /// unoccluded within the zone around the machine.
  std::vector<std::string> MountWarnings() const;

  /// Throws InputError if a zone had no place in the air at any moment.
  void RequirePlaces() const;
  std::vector<Figure> Figures() const;
  /// Writes figures, maps, curves, causes, overlaps and warnings into `report`.
  void Report(LayoutReport* report) const;

 private:
  const MachineModel& model() const;
  void AddZonesAndMaps(const WantedFigures& wanted);
  void AddPeople(const WantedFigures& wanted);
  void AddShovels(const WantedFigures& wanted);

  const LayoutStudy& study_;
  const Scenario& scenario_;
  const SceneAssembly& assembly_;
  StudiedMachine studied_;
  std::vector<ZoneCoverage> zones_;
  std::vector<BlindMap> maps_;
  std::vector<PersonRange> people_;
  std::vector<ShovelView> shovels_;
  // Empty if the measure is not requested.
  std::optional<ElevationMap> elevation_;
  std::optional<PixelDensity> pixels_;
  std::optional<OccupancyEntropy> occupancy_;
  std::optional<PerceptionEntropy> entropy_;
  std::optional<SkyView> sky_;
  MountCheck mounts_;
  std::vector<double> outline_m_;  ///< maximum of HullRadii_m over the added moments
  std::set<std::string> flat_;     ///< viewers whose beams have equal elevation
};

}  // namespace tera
