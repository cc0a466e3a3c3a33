#pragma once

#include <string_view>

#include "core/motion.h"
#include "core/types/effects.h"

/// Parameters of a mechanism; `ideal` for a target without the mechanism.

namespace tera {

inline double NumberOf(const Effects& effects, std::string_view id, std::string_view parameter,
                       double ideal) {
  const Effect* effect = FindEffect(effects, id);
  return effect ? (*effect)[parameter] : ideal;
}

inline Vec3 VectorOf(const Effects& effects, std::string_view id, std::string_view x,
                     std::string_view y, std::string_view z, double ideal = 0) {
  return {NumberOf(effects, id, x, ideal), NumberOf(effects, id, y, ideal),
          NumberOf(effects, id, z, ideal)};
}

}  // namespace tera
