#pragma once

#include <vector>

#include "core/config/config.h"
#include "core/motion.h"

namespace tera {

/// Reads `outline_m`: the corners in W of a polygon that does not cross itself. Empty if faulty.
std::vector<Vec2> ReadOutline(const ConfigMap& item);

/// True if the point lies inside the outline.
bool Encloses(const std::vector<Vec2>& outline_W_m, const Vec2& p_W_m);

}  // namespace tera
