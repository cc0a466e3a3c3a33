#pragma once

#include <string>
#include <vector>

#include "core/time.h"
#include "sim/scenario/scenario.h"
#include "sim/simulation.h"
#include "tera/v1/simulation.pb.h"

/// Observations that a client requests, checked against the scenario, and the conversion of states
/// to messages.

namespace tera {

/// A grid of ground heights around the root link of a machine or the cutting edge of a shovel.
struct PatchPlan {
  std::size_t machine = 0;
  int shovel = -1;  ///< index of the shovel; -1: around the root link
  int n = 0;        ///< number of vertices along each side
  double resolution_m = 0;
};

/// A sensor whose samples are collected.
struct SensorPlan {
  std::string machine, sensor;
  bool latest_only = false;
};

struct ObservationPlan {
  std::vector<PatchPlan> patches;
  std::vector<SensorPlan> sensors;
  double bytes = 0;  ///< upper bound of the message size due to samples and patches
};

/// Throws InputError if a machine, shovel or sensor does not exist or is repeated. Also throws if a
/// patch has an invalid size, or if samples over `duration_s` may exceed kLargestSamples_bytes.
ObservationPlan PlanObservation(const v1::Observe& observe, const Scenario& scenario,
                                double duration_s);

/// Writes time, machine states and terrain patches.
void PutState(const WorldState& state, const Scenario& scenario,
              const std::vector<PatchPlan>& patches, v1::Observation* observation);

/// Index of the machine with this name. Throws InputError if there is none.
std::size_t MachineIndex(const Scenario& scenario, const std::string& name);

}  // namespace tera
