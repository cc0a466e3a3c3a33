#pragma once

#include <vector>

#include "render/scene.h"
#include "sim/carried_soil.h"
#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Builds the constant SceneModel of a scenario, and computes the poses of its bodies for each
/// state.
///
/// Model   bodies: each link, wheel, track shoe, rocker, coupler, cylinder barrel, cylinder rod,
///         shovel load, obstacle and obstacle wheel, and the site's mesh.
///         Labelled instances: each link, track, wheel, shovel load, obstacle and part of the
///         site's mesh. Names are "machine/part" or the obstacle's name. Each machine also has an
///         instance as a whole, whose parts are its other instances except the loads. A shovel load
///         is a deforming mesh (CarriedSoil).
class SceneAssembly {
 public:
  /// Throws InputError if a mesh cannot be loaded; the message names the place in the scenario.
  explicit SceneAssembly(const Scenario& scenario);

  const SceneModel& model() const { return model_; }
  /// Poses of all bodies, by body index.
  std::vector<Pose> BodyPoses(const Instant& state) const;
  /// Current mesh of the soil in each shovel.
  Shapes ShapesOf(const Instant& state) const;

 private:
  struct TrackPath {
    std::size_t machine;
    const TrackVisual* track;
    double radius_m;
    std::vector<double> arc_m;  ///< arc length of the closed path up to each corner, and its total
  };

  void AddMachine(const Scenario& scenario, std::size_t m);
  void AddRunningGear(const MachinePlacement& placement, std::size_t m,
                      const std::vector<int>& link_body, const NodeWear& wear);
  /// Adds the soil bodies of the shovels.
  void AddLoads(const MachinePlacement& placement, std::size_t m,
                const std::vector<SoilType>& soils);
  /// Adds key points of joints and edges. They receive the machine's instance later.
  void AddMachineKeypoints(const MachineModel& machine, const std::vector<int>& link_body);
  void AddObstacle(const ScenarioObstacle& obstacle);
  /// Adds the mesh of the site and the colours of its ground.
  void AddSiteMesh(const SiteMesh& site, const TerrainSurface& ground);
  void AddWhole(const Scenario& scenario, std::size_t m);
  void AddLamp(const ScenarioLamp& lamp);
  std::uint16_t AddInstance(const std::string& name, SemanticClass label, int body);
  void AddNode(const Visual& visual, int body, SemanticClass label, std::uint16_t instance,
               const NodeWear& wear);
  /// Extends the box of the node's instance by its mesh, if both belong to one body.
  void GrowBox(const SceneNode& node);
  void AppendMachinePoses(const Instant& state, std::size_t m, std::vector<Pose>* poses) const;
  int AddBody() { return model_.body_count++; }

  const Scenario& scenario_;
  SceneModel model_;
  std::vector<TrackPath> tracks_;
  /// Per machine: index of its first body, and one past its last.
  std::vector<int> root_body_, end_body_;
  struct ShovelLoad {
    std::size_t machine;
    int shovel;
    CarriedSoil look;
  };
  std::vector<ShovelLoad> loads_;  ///< by shape index
};

}  // namespace tera
