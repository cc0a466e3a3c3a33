#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "render/gl/rasterizer_pool.h"
#include "render/rays/ray_scene.h"
#include "sensors/sampling.h"
#include "sim/dust/site_dust.h"
#include "sim/ground_copies.h"
#include "sim/scene_assembly.h"
#include "sim/world_state.h"

namespace tera {

/// The scene of a running simulation as its sensors see it, with the past poses that they need.
class RigScene : public SensedScene {
 public:
  /// Keeps a reference to `assembly`.
  RigScene(const SceneAssembly& assembly, int threads);
  ~RigScene() override;

  /// Prepares pictures. If `late`, rasterizers run in parallel with the run. Otherwise the first
  /// picture creates one. Throws InputError (here or at the first picture) if OpenGL is not
  /// available.
  void OpenRasterizers(const EglOptions& egl, bool late);
  /// Keeps past poses from now on.
  void KeepPast() { keeps_past_ = true; }
  /// Simulates the scenario's dust, if any, from now on.
  void FollowAir(const Scenario& scenario) { scenario_ = &scenario; }

  /// Advances to a step. The step's states and ground must stay valid until the next call.
  void Advance(const WorldStep& step);
  void ForgetBefore(TimeNs t_ns);

  const TerrainSurface& ground() const override { return *ground_; }
  Shapes ShapesNow() const override;
  std::vector<Pose> BodiesBetween(double s) const override;
  std::vector<Pose> BodiesAt(TimeNs t_ns) const override;
  SensedAir air() const override;
  KeptScene Keep() const override;
  RasterizerPool* rasterizers() const override;
  /// Created at the first scan.
  RayScene* ray_scene() const override;
  /// Wall-clock seconds of the busiest rasterizer.
  double busy_s() const { return rasterizers_ ? rasterizers_->busy_s() : 0.0; }
  int threads() const override { return threads_; }

 private:
  /// Poses of all scene bodies at a step.
  struct Moment {
    TimeNs t_ns;
    std::vector<Pose> X_WB;
  };

  const SceneAssembly& assembly_;
  int threads_;
  EglOptions egl_;
  mutable std::unique_ptr<RasterizerPool> rasterizers_;
  mutable std::unique_ptr<RayScene> ray_scene_;
  const Instant *before_ = nullptr, *after_ = nullptr;
  const TerrainSurface* ground_ = nullptr;
  mutable Shapes shapes_;  ///< of this step, valid if shapes_known_
  mutable bool shapes_known_ = false;
  mutable GroundCopies ground_copies_;
  mutable std::optional<KeptScene> kept_;  ///< copy of this step's scene, once requested
  mutable std::shared_ptr<const DustVolume> dust_copy_;  ///< latest copy
  bool keeps_past_ = false;
  std::deque<Moment> history_;
  const Scenario* scenario_ = nullptr;  ///< set if dust is to be simulated
  std::optional<SiteDust> dust_;
};

}  // namespace tera
