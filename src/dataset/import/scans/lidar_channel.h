#pragma once

#include "dataset/import/import_run.h"

namespace tera {

/// Imports the scans of a real lidar, from an entry of the mapping's `lidars`. The source is
/// packets in a capture or bag, points in a bag, or a folder of scans. Memory holds one scan, plus
/// those that are being written.
ImportJob ReadLidar(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);

}  // namespace tera
