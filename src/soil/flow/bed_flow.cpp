#include "soil/flow/bed_flow.h"

namespace tera {

void BedFlow::Flow(double dt_s, Bed* bed, Columns* ground, Grains* grains) {
  if (bed->load().mass_kg <= 0) return;
  avalanche_.Flow(dt_s, &bed->columns(), grains);
  for (const Bed::Overflow& fallen : bed->TakeOverflow()) {
    grains->Pour(fallen.soil, fallen.p_W_m, fallen.p_W_m, fallen.v_W_mps, ground);
  }
}

}  // namespace tera
