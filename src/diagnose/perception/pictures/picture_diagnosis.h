#pragma once

#include <cstdint>

#include "dataset/format/recording.h"
#include "diagnose/perception/perception_diagnosis.h"
#include "diagnose/perception/pictures/picture_registration.h"
#include "resimulate/picture_caster.h"
#include "resimulate/recorded_sensors.h"

namespace tera {

/// Diagnoses a camera's mount and clock: `extrinsic` and `clock_offset`.
///
/// Model   landmarks of picture_registration.h, with the search for ranges (registration_search.h).
///         After a finding, the pictures are rendered under it and searched again, twice. Not
///         judged: fewer than ten blocks of time; pictures under 32 pixels in width or height, or
///         without contrast; fewer than 40 landmarks per picture; pictures unlike the simulated
///         ones even under the best calibration (correlation below 0.5, edges more than a pixel
///         away).
/// Omits   the lens, rolling shutter, and differences of the scene.
PerceptionDiagnosis DiagnosePictures(const PictureSource& source, std::uint64_t seed);

/// Compares recorded with rendered pictures, both reduced to a width of at most 400 pixels.
PerceptionDiagnosis DiagnoseCamera(const RecordedSensor& camera, const Recording& recording,
                                   std::uint64_t seed, PictureCaster* caster);

}  // namespace tera
