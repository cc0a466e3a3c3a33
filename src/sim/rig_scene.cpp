#include "sim/rig_scene.h"

#include <algorithm>

#include "core/check.h"

namespace tera {
namespace {

std::vector<Pose> Between(const std::vector<Pose>& from, const std::vector<Pose>& to, double s) {
  std::vector<Pose> poses;
  poses.reserve(to.size());
  for (std::size_t b = 0; b < to.size(); ++b) poses.push_back(Interpolate(from[b], to[b], s));
  return poses;
}

}  // namespace

RigScene::RigScene(const SceneAssembly& assembly, int threads)
    : assembly_(assembly), threads_(threads) {}

RigScene::~RigScene() = default;

/// With a single thread, that thread renders the pictures.
void RigScene::OpenRasterizers(const EglOptions& egl, bool late) {
  egl_ = egl;
  if (!late) return;
  const int beside = threads_ > 1 ? RasterizerPool::FittingCount(egl, threads_) : 0;
  rasterizers_ = std::make_unique<RasterizerPool>(assembly_.model(), egl, threads_, beside);
}

RasterizerPool* RigScene::rasterizers() const {
  if (!rasterizers_) {
    rasterizers_ = std::make_unique<RasterizerPool>(assembly_.model(), egl_, threads_, 0);
  }
  return rasterizers_.get();
}

RayScene* RigScene::ray_scene() const {
  if (!ray_scene_) ray_scene_ = std::make_unique<RayScene>(assembly_.model());
  return ray_scene_.get();
}

void RigScene::Advance(const WorldStep& step) {
  before_ = &step.before;
  after_ = &step.after;
  ground_ = &step.ground;
  shapes_known_ = false;
  kept_.reset();
  if (scenario_ != nullptr && scenario_->environment.weather.dust) {
    if (!dust_) dust_.emplace(*scenario_, step.before, step.ground);
    dust_->Step(step);
  }
  if (!keeps_past_) return;
  TERA_CHECK(history_.empty() || after_->t_ns > history_.back().t_ns, after_->t_ns);
  history_.push_back({after_->t_ns, assembly_.BodyPoses(*after_)});
}

void RigScene::ForgetBefore(TimeNs t_ns) {
  while (history_.size() > 1 && history_[1].t_ns <= t_ns) history_.pop_front();
}

/// Computed at the first request in a step.
Shapes RigScene::ShapesNow() const {
  if (!shapes_known_) shapes_ = assembly_.ShapesOf(*after_);
  shapes_known_ = true;
  return shapes_;
}

SensedAir RigScene::air() const {
  SensedAir air;
  if (dust_) air.dust = &dust_->volume();
  if (scenario_ != nullptr) {
    const Weather& weather = scenario_->environment.weather;
    air.rain_mmph = weather.rain_mmph;
    air.snowfall_mmph = weather.snowfall_mmph;
    air.visibility_m = weather.visibility_m;
  }
  return air;
}

/// Copies at most once per step, and only if pictures are rendered in parallel.
KeptScene RigScene::Keep() const {
  if (!rasterizers_ || !rasterizers_->work_beside()) return SensedScene::Keep();
  if (kept_) return *kept_;
  const DustVolume* dust = air().dust;
  const bool is_new = dust != nullptr && (!dust_copy_ || dust_copy_->version != dust->version);
  if (is_new) dust_copy_ = std::make_shared<const DustVolume>(*dust);
  kept_ = {ground_copies_.Of(*ground_), ShapesNow(), dust_copy_};
  return *kept_;
}

std::vector<Pose> RigScene::BodiesBetween(double s) const {
  return Between(assembly_.BodyPoses(*before_), assembly_.BodyPoses(*after_), s);
}

std::vector<Pose> RigScene::BodiesAt(TimeNs t_ns) const {
  const auto after = std::lower_bound(history_.begin(), history_.end(), t_ns,
                                      [](const Moment& m, TimeNs t) { return m.t_ns < t; });
  if (after == history_.end()) return history_.back().X_WB;
  if (after == history_.begin() || after->t_ns == t_ns) return after->X_WB;
  const auto before = after - 1;
  const double s =
      static_cast<double>(t_ns - before->t_ns) / static_cast<double>(after->t_ns - before->t_ns);
  return Between(before->X_WB, after->X_WB, s);
}

}  // namespace tera
