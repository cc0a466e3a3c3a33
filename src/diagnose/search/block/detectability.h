#pragma once

#include <optional>

#include "diagnose/search/block/judged_block.h"
#include "diagnose/search/structure/structure_search.h"

namespace tera {

/// How small a suspect's main number may be and still be seen, were noise the only trouble.
struct Detectability {
  const Suspect* suspect = nullptr;
  std::optional<double> smallest;  ///< none: not even the strongest start would be seen
};

/// By the first of the suspect's starts, from faint to strong, that would pass the tests of what is
/// seen and of FINAL under three quarters of twenty draws of the noise, its number being known.
Detectability DetectabilityOf(const JudgedBlock& judged, const Suspect& suspect);

}  // namespace tera
