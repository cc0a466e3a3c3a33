#include "sensors/camera/optics/optics_model.h"

namespace tera {

static void Serialize(ModelArchive* archive, GlareModel* m) {
  archive->Visit("scattered", &m->scattered, Between(0, 0.5, "1"));
  archive->Visit("core_deg", &m->core_deg, Between(0.01, 20, "deg"));
  archive->Visit("slope", &m->slope, Between(1, 6, "1"));
}

static void Serialize(ModelArchive* archive, FlareModel* m) {
  archive->Visit("ghosts", &m->ghosts, Between(1, 100, ""));
  archive->Visit("reflectance", &m->reflectance, Between(0, 0.2, "1"));
}

static void Serialize(ModelArchive* archive, SoilingModel* m) {
  constexpr double kMostPieces = 2000;
  archive->Visit("distance_mm", &m->distance_mm, Between(0.5, 1000, "mm"));
  archive->Visit("film", &m->film, Between(0, 0.9, "1"));
  archive->Visit("specks", &m->specks, Between(0, kMostPieces, ""));
  archive->Visit("speck_mm", &m->speck_mm, Between(0.01, 50, "mm"));
  archive->Visit("drops", &m->drops, Between(0, kMostPieces, ""));
  archive->Visit("drop_mm", &m->drop_mm, Between(0.1, 20, "mm"));
  archive->Check(m->film > 0 || m->specks > 0 || m->drops > 0, "",
                 "without film, specks and drops the glass is clean; need one of them above 0, "
                 "or no soiling");
}

void Serialize(ModelArchive* archive, OpticsModel* m) {
  archive->Visit("focus_m", &m->focus_m, Between(0.05, 1e6, "m"));
  archive->Visit("glare", &m->glare);
  archive->Visit("flare", &m->flare);
  archive->Visit("soiling", &m->soiling);
  archive->Check(m->focus_m || m->glare || m->flare || m->soiling, "",
                 {FaultKind::kMissing,
                  "is empty; need some of focus_m, glare, flare and soiling, or no optics"});
}

}  // namespace tera
