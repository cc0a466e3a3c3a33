#pragma once

#include <string>
#include <vector>

#include "dataset/format/recording.h"
#include "diagnose/perception/perception_diagnosis.h"
#include "resimulate/picture_caster.h"

namespace tera {

/// A colour camera of a machine, and its pictures in a recording.
struct RecordedCamera {
  std::size_t machine = 0;
  const SensorDescription* description = nullptr;
  std::string channel;
  const std::vector<ScanCaster::Scan>* pictures = nullptr;
};

/// Whether what a sensor records is compared as pictures: colour without depth.
bool TakesPictures(const SensorDescription& sensor);

/// Compares recorded with rendered pictures, both reduced to 400 pixels' width at most.
PerceptionDiagnosis DiagnoseCamera(const RecordedCamera& camera, const Recording& recording,
                                   std::uint64_t seed, PictureCaster* caster);

}  // namespace tera
