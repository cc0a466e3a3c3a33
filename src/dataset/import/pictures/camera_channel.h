#pragma once

#include "dataset/import/import_run.h"

namespace tera {

/// Imports the pictures of a real camera, an entry of a mapping's `cameras`: a topic of a bag, or a
/// folder of PNG or JPEG files. Memory holds one picture, and those that are being written.
ImportJob ReadCamera(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);

}  // namespace tera
