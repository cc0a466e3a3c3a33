#include "diagnose/search/structure/effect_size.h"

#include <algorithm>
#include <cmath>

namespace tera {

double EffectOf(const ReplayBlock& block, const Misfit& with, const Misfit& without) {
  double largest = 0;
  for (std::size_t c = 0; c < with.residual.size(); ++c) {
    const Series& measured = block.channels[c].measured;
    double changed = 0, energy = 0;
    for (std::size_t k = 0; k < measured.size(); ++k) {
      if (!measured.valid[k]) continue;
      changed += std::pow(with.residual[c].value[k] - without.residual[c].value[k], 2);
      energy += std::pow(measured.value[k], 2);
    }
    if (energy > 0) largest = std::max(largest, std::sqrt(changed / energy));
  }
  return largest;
}

}  // namespace tera
