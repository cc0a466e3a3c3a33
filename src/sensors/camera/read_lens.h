#pragma once

#include <string>
#include <string_view>

#include "core/config/config.h"
#include "render/gl/camera_intrinsics.h"

namespace tera {

/// Reads image size, lens and distances of a camera. A lens that folds within its image is a fault.
CameraIntrinsics ReadLens(const ConfigMap& config);
/// The lens as in sensor.yaml, indented by two blanks.
std::string LensYaml(const CameraIntrinsics& lens);
/// Name of a projection law in the key `lens`.
std::string_view NameOf(LensKind kind);

}  // namespace tera
