#pragma once

#include <array>
#include <variant>

#include "sensors/camera/camera.h"
#include "sensors/encoder/encoder.h"
#include "sensors/gnss/gnss.h"
#include "sensors/imu/imu.h"
#include "sensors/inclinometer/inclinometer.h"
#include "sensors/lidar/lidar.h"
#include "sensors/sensor_kind.h"

// All sensor kinds. Each kind has its own folder. Its model is an alternative of SensorModel, at
// the same position as its entry in the table (docs/extending.md, "Add a sensor").

namespace tera {

using SensorModel =
    std::variant<ImuModel, GnssModel, CameraModel, LidarModel, EncoderModel, InclinometerModel>;

extern const SensorKind kImuKind, kGnssKind, kCameraKind, kLidarKind, kEncoderKind,
    kInclinometerKind;

inline constexpr std::array<const SensorKind*, std::variant_size_v<SensorModel>> kSensorKinds = {
    &kImuKind, &kGnssKind, &kCameraKind, &kLidarKind, &kEncoderKind, &kInclinometerKind};

}  // namespace tera
