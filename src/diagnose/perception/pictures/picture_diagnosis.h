#pragma once

#include <cstdint>

#include "diagnose/perception/perception_diagnosis.h"
#include "diagnose/perception/pictures/picture_source.h"

namespace tera {

/// Whether a camera sits elsewhere, or its clock is off: `extrinsic` and `clock_offset`.
///
/// Model   landmarks of picture_registration.h, searched as ranges are (registration_search.h).
/// Where
///         something is found, the pictures are rendered again under it, and searched again, twice.
///         Not judged: fewer than ten blocks of time, pictures of fewer than 32 pixels
///         either way, without contrast, fewer than 40
///         landmarks a picture, pictures that even under the best calibration are not like
///         the simulated ones (correlation below 0.5, edges further than a pixel).
/// Omits   the lens, rolling shutter, and what of the scene differs.
PerceptionDiagnosis DiagnosePictures(const PictureSource& source, std::uint64_t seed);

}  // namespace tera
