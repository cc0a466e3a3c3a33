#pragma once

namespace tera {

/// Largest forces, either way, with which a base is driven.
struct BaseEffort {
  double forward_n = 0, left_n = 0, yaw_nm = 0;
};

}  // namespace tera
