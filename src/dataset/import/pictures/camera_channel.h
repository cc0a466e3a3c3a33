#pragma once

#include "dataset/import/import_run.h"

namespace tera {

/// Imports the images of a real camera, from an entry of the mapping's `cameras`. The source is a
/// topic of a bag or a folder of PNG or JPEG files. Memory holds one image, plus those that are
/// being written.
ImportJob ReadCamera(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);

}  // namespace tera
