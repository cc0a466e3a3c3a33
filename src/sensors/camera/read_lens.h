#pragma once

#include <string>
#include <string_view>

#include "core/config/config.h"
#include "render/gl/camera_intrinsics.h"

namespace tera {

/// A camera's size, lens and distances from its keys. A lens that folds within its picture is a
/// fault.
CameraIntrinsics ReadLens(const ConfigMap& config);
/// The same as sensor.yaml has it, two blanks before each key.
std::string LensYaml(const CameraIntrinsics& lens);
/// A law as the key `lens` names it.
std::string_view NameOf(LensKind kind);

}  // namespace tera
