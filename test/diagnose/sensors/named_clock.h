#pragma once

#include <string>

#include "diagnose/sensors/sensor_diagnosis.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {

/// An estimate that names only the clock of `target`, late by `offset_s`.
inline SensorDiagnosis NamedClock(const std::string& target, double offset_s) {
  SensorFinding found;
  found.target = target;
  found.mechanism = &SensorMechanism("clock_offset", EffectTarget::kEncoder);
  found.numbers = {{"offset_s", "s", offset_s, 0.01, 0, 0.04, true}};
  SensorDiagnosis estimate;
  estimate.findings = {found};
  return estimate;
}

}  // namespace tera
