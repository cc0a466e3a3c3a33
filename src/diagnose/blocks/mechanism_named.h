#pragma once

#include <algorithm>
#include <span>
#include <string_view>

#include "core/check.h"
#include "core/effects.h"

namespace tera {

/// The mechanism of `library` with that id, which must be there.
inline const Mechanism& MechanismNamed(std::string_view id, std::span<const Mechanism> library) {
  const auto found =
      std::find_if(library.begin(), library.end(), [&](const Mechanism& m) { return m.id == id; });
  TERA_CHECK(found != library.end(), id);
  return *found;
}

}  // namespace tera
