#include "render/gl/pinhole_painter.h"

#include <utility>

namespace tera {

PinholePainter::PinholePainter(const SceneModel& model, Workers* workers,
                               std::function<void(const char* pass)> done)
    : done_(std::move(done)),
      daylight_(model.environment),
      nodes_(model),
      terrain_(model, daylight_.sky().to_sun_W(), workers),
      grains_(model.soils),
      shadow_map_(daylight_.sky().to_sun_W()),
      lamps_(model.lamps),
      shading_(!model.lamps.empty()) {
  const Weather& weather = model.environment.weather;
  if (weather.rain_mmph > 0) rain_.emplace(weather);
}

std::int64_t PinholePainter::triangles_drawn() const {
  return nodes_.triangles_drawn() + terrain_.triangles_drawn() + grains_.triangles_drawn();
}

void PinholePainter::Draw(const View& view, const SceneState& state, const Pictures& p,
                          LightPass* light) {
  TakeScene(view, state);
  geometry_.DrawNodes(view, nodes_, p);
  done_("machines and obstacles");
  if (has_ground_) {
    geometry_.DrawGround(view, terrain_, grains_);
    done_("ground");
  }
  shading_.Occlude(view, p);
  done_("ambient occlusion");
  const Lights lights{daylight_, shadow_map_, lamps_, has_ground_ ? &terrain_.textures() : nullptr};
  shading_.Shade(view, lights, p, light != nullptr ? light->TargetOf(p) : p.sky_target.id());
  done_("shading");
  sky_and_glass_.Draw(view, daylight_, nodes_, p);
  done_("sky, glass, lights");
  DrawAir(view, state, p);
  done_("dust, rain");
  tone_.Draw(p);
  done_("tone and edges");
}

/// Uploads changes of the scene and updates shadows. Afterwards the nodes are placed for `view`.
void PinholePainter::TakeScene(const View& view, const SceneState& state) {
  has_ground_ = state.terrain != nullptr;
  if (has_ground_) {
    terrain_.Update(*state.terrain);
    grains_.Place(*state.terrain, view.eye_W_m);
  }
  nodes_.Reshape(state);
  done_("changed ground");
  shadow_map_.Update(state, view.eye_W_m, &nodes_);
  lamps_.Update(state, &nodes_);
  done_("shadow pictures");
  nodes_.Place(state, view.eye_W_m, &view);
}

void PinholePainter::DrawAir(const View& view, const SceneState& state, const Pictures& p) {
  if (state.dust != nullptr) {
    if (!dust_) dust_.emplace();
    dust_->Draw(view, *state.dust, daylight_, p);
  }
  if (rain_) rain_->Draw(view, state, daylight_, p);
}

}  // namespace tera
