#pragma once

#include "sim/scenario/scenario.h"
#include "tera/v1/simulation.pb.h"

namespace tera {

/// Converts a scenario to the description that clients receive.
v1::Description Describe(const Scenario& scenario);

}  // namespace tera
