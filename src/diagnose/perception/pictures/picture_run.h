#pragma once

#include <cstdint>

#include "dataset/format/recording.h"
#include "diagnose/perception/perception_diagnosis.h"
#include "resimulate/picture_caster.h"
#include "resimulate/recorded_sensors.h"

namespace tera {

/// Compares recorded with rendered pictures, both reduced to a width of at most 400 pixels.
PerceptionDiagnosis DiagnoseCamera(const RecordedSensor& camera, const Recording& recording,
                                   std::uint64_t seed, PictureCaster* caster);

}  // namespace tera
