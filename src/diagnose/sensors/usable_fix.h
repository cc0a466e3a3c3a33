#pragma once

#include "core/types/measurement.h"

namespace tera {

/// True if a fix is at least as good as documented.
inline bool IsAsDocumented(GnssFix fix, GnssFix documented) {
  const auto rank = [](GnssFix one) {
    return one == GnssFix::kRtkFixed ? 4 : one == GnssFix::kRtkFloat ? 3 : static_cast<int>(one);
  };
  return fix != GnssFix::kNone && rank(fix) >= rank(documented);
}

}  // namespace tera
