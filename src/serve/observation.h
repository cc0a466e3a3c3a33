#pragma once

#include <string>
#include <vector>

#include "core/time.h"
#include "sim/scenario/scenario.h"
#include "sim/simulation.h"
#include "tera/v1/simulation.pb.h"

/// What a client asked to see, checked against the scenario, and the state as it is told.

namespace tera {

/// A grid of ground heights around a machine's root link or the cutting edge of its shovel.
struct PatchPlan {
  std::size_t machine = 0;
  int shovel = -1;  ///< -1: around the root link
  int n = 0;        ///< vertices along an edge
  double resolution_m = 0;
};

/// A sensor whose samples are kept.
struct SensorPlan {
  std::string machine, sensor;
  bool latest_only = false;
};

struct ObservationPlan {
  std::vector<PatchPlan> patches;
  std::vector<SensorPlan> sensors;
};

/// Throws InputError for machines, shovels and sensors that are not there or are named twice, for a
/// patch without a sensible size, and for samples that would take more than kLargestSamples_bytes
/// over `duration_s`.
ObservationPlan PlanObservation(const v1::Observe& observe, const Scenario& scenario,
                                double duration_s);

/// Time, machines and terrain patches.
void PutState(const WorldState& state, const Scenario& scenario,
              const std::vector<PatchPlan>& patches, v1::Observation* observation);

/// Index of the machine of that name. Throws InputError where there is none.
std::size_t MachineIndex(const Scenario& scenario, const std::string& name);

}  // namespace tera
