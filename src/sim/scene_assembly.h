#pragma once

#include <vector>

#include "render/scene.h"
#include "sim/carried_soil.h"
#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Turns a scenario into what can be seen: builds the constant SceneModel once and places its
/// bodies for each state.
///
/// Model   one body for each link, wheel, track shoe, rocker and coupler, cylinder barrel and rod,
///         shovel's soil, obstacle and wheel of one, one for the site's mesh; one labelled instance
///         for each link, track, wheel, shovel's soil, obstacle and part of that mesh, named
///         "machine/part" or after the obstacle; one more for each machine as a whole, whose parts
///         all of these are but the soil. Soil in a shovel is a mesh that changes (CarriedSoil).
class SceneAssembly {
 public:
  /// Throws InputError where a mesh cannot be loaded, with the place that names it.
  explicit SceneAssembly(const Scenario& scenario);

  const SceneModel& model() const { return model_; }
  /// Poses of all bodies, in the order of their index.
  std::vector<Pose> BodyPoses(const Instant& state) const;
  /// The soil in each shovel as it lies now.
  Shapes ShapesOf(const Instant& state) const;

 private:
  struct TrackPath {
    std::size_t machine;
    const TrackVisual* track;
    double radius_m;
    std::vector<double> arc_m;  ///< length along the closed path up to each corner, and in all
  };

  void AddMachine(const Scenario& scenario, std::size_t m);
  void AddRunningGear(const MachinePlacement& placement, std::size_t m,
                      const std::vector<int>& link_body, const NodeWear& wear);
  /// What shovels will carry.
  void AddLoads(const MachinePlacement& placement, std::size_t m,
                const std::vector<SoilType>& soils);
  /// Joints and edges, of no instance until the machine as a whole has one.
  void AddMachineKeypoints(const MachineModel& machine, const std::vector<int>& link_body);
  void AddObstacle(const ScenarioObstacle& obstacle);
  /// The mesh of the site, and the colours of its ground.
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
  std::vector<int> root_body_, end_body_;  ///< of each machine: its first, and one after its last
  struct ShovelLoad {
    std::size_t machine;
    int shovel;
    CarriedSoil look;
  };
  std::vector<ShovelLoad> loads_;  ///< in the order of shapes
};

}  // namespace tera
