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

// All sensor kinds. The model of a kind has the same index in SensorModel as the kind in
// kSensorKinds (docs/extending.md, "Add a sensor").

namespace tera {

using SensorModel =
    std::variant<ImuModel, GnssModel, CameraModel, LidarModel, EncoderModel, InclinometerModel>;

extern const SensorKind kImuKind, kGnssKind, kCameraKind, kLidarKind, kEncoderKind,
    kInclinometerKind;

inline constexpr std::array<const SensorKind*, std::variant_size_v<SensorModel>> kSensorKinds = {
    &kImuKind, &kGnssKind, &kCameraKind, &kLidarKind, &kEncoderKind, &kInclinometerKind};

}  // namespace tera
