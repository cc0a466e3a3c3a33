#pragma once

#include "sim/scenario/scenario.h"
#include "tera/v1/simulation.pb.h"

namespace tera {

/// What a client is told of a scenario.
v1::Description Describe(const Scenario& scenario);

}  // namespace tera
