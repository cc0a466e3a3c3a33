#pragma once

#include <vector>

#include "core/config/config.h"
#include "core/motion.h"

namespace tera {

/// Reads `outline_m`: corners in W of a polygon that does not cross itself. A faulty one is empty.
std::vector<Vec2> ReadOutline(const ConfigMap& item);

/// Whether a point lies within an outline.
bool Encloses(const std::vector<Vec2>& outline_W_m, const Vec2& p_W_m);

}  // namespace tera
