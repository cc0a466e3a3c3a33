#pragma once

#include <vector>

#include "render/scene.h"
#include "sim/carried_soil.h"
#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Builds the constant SceneModel of a scenario once, and places its bodies for each state.
///
/// Model   one body for each link, wheel, track shoe, rocker and coupler, cylinder barrel and rod,
///         shovel's soil, obstacle and obstacle's wheel. One more for the site's mesh. One labelled
///         instance for each link, track, wheel, shovel's soil, obstacle and part of that mesh,
///         named "machine/part" or after the obstacle. One more instance for each machine as a
///         whole, whose parts are all of its instances except the soil. The soil in a shovel is a
///         changing mesh (CarriedSoil).
class SceneAssembly {
 public:
  /// Throws InputError if a mesh cannot be loaded, with the place that names it.
  explicit SceneAssembly(const Scenario& scenario);

  const SceneModel& model() const { return model_; }
  /// Poses of all bodies, in the order of their index.
  std::vector<Pose> BodyPoses(const Instant& state) const;
  /// The current soil in each shovel.
  Shapes ShapesOf(const Instant& state) const;

 private:
  struct TrackPath {
    std::size_t machine;
    const TrackVisual* track;
    double radius_m;
    std::vector<double> arc_m;  ///< length along the closed path up to each corner, then in total
  };

  void AddMachine(const Scenario& scenario, std::size_t m);
  void AddRunningGear(const MachinePlacement& placement, std::size_t m,
                      const std::vector<int>& link_body, const NodeWear& wear);
  /// Adds the soil bodies of the shovels.
  void AddLoads(const MachinePlacement& placement, std::size_t m,
                const std::vector<SoilType>& soils);
  /// Adds joints and edges, which get the machine's instance later.
  void AddMachineKeypoints(const MachineModel& machine, const std::vector<int>& link_body);
  void AddObstacle(const ScenarioObstacle& obstacle);
  /// Adds the mesh of the site, and the colours of its ground.
  void AddSiteMesh(const SiteMesh& site, const TerrainSurface& ground);
  void AddWhole(const Scenario& scenario, std::size_t m);
  void AddLamp(const ScenarioLamp& lamp);
  std::uint16_t AddInstance(const std::string& name, SemanticClass label, int body);
  void AddNode(const Visual& visual, int body, SemanticClass label, std::uint16_t instance,
               const NodeWear& wear);
  /// Widens the box of the node's instance to hold its mesh, if both move with one body.
  void GrowBox(const SceneNode& node);
  void AppendMachinePoses(const Instant& state, std::size_t m, std::vector<Pose>* poses) const;
  int AddBody() { return model_.body_count++; }

  const Scenario& scenario_;
  SceneModel model_;
  std::vector<TrackPath> tracks_;
  std::vector<int> root_body_, end_body_;  ///< per machine: its first body, and one past its last
  struct ShovelLoad {
    std::size_t machine;
    int shovel;
    CarriedSoil look;
  };
  std::vector<ShovelLoad> loads_;  ///< in the order of shapes
};

}  // namespace tera
