#pragma once

#include <memory>
#include <string>

#include "core/config/config.h"
#include "physics/description/machine.h"
#include "sensors/sensor.h"

namespace tera {

/// A camera of 10 Hz on the only link of a machine.
struct CameraOnALink {
  /// `keys` of the camera, except its rate.
  explicit CameraOnALink(const std::string& keys) {
    const Config config = Config::FromText(
        "sensor: {name: s, type: camera, link: upper, rate_hz: 10, " + keys + "}", "rig.yaml");
    sensor = ReadSensor(config.root().Map("sensor"));
    config.Finish();
    machine.links.emplace_back();
    machine.links.back().name = "upper";
  }
  /// The camera's sampler, writing to a channel of `sink`. Both must outlive it.
  std::unique_ptr<SensorSampler> SamplerInto(MeasurementSink* sink) const {
    return KindOf(sensor).sampler({sensor, {sensor}, machine, "m/s", 1, {sink, 0}});
  }

  SensorDescription sensor;
  MachineModel machine;
};

}  // namespace tera
