#pragma once

#include <cstdint>

#include "dataset/format/recording.h"
#include "diagnose/perception/perception_diagnosis.h"
#include "diagnose/perception/pictures/picture_registration.h"
#include "resimulate/picture_caster.h"
#include "resimulate/recorded_sensors.h"

namespace tera {

/// Diagnoses the mount (`extrinsic`) and the clock (`clock_offset`) of a camera.
///
/// Model   Picture residuals come from picture_registration.h. The search is the one for ranges
///         (registration_search.h). After a finding, the pictures are rendered under it and
///         searched again, at most twice.
///         A camera is not judged in four cases: fewer than ten blocks of time; pictures under 32
///         pixels in width or height, or without contrast; fewer than 40 landmarks per picture;
///         poor agreement even under the best calibration. Agreement is poor if the correlation is
///         below 0.5 or the edges are more than a pixel away.
/// Omits   The lens, rolling shutter, and differences of the scene.
PerceptionDiagnosis DiagnosePictures(const PictureSource& source, std::uint64_t seed);

/// Compares recorded with rendered pictures, reduced to a width of at most 400 pixels.
PerceptionDiagnosis DiagnoseCamera(const RecordedSensor& camera, const Recording& recording,
                                   std::uint64_t seed, PictureCaster* caster);

}  // namespace tera
