#pragma once

#include <string>

#include "view/stage.h"

namespace tera {

/// Bytes of a stage for web/src/stage/stage_file.js: "TSTG", the header length as a 32-bit number,
/// the JSON header, and the arrays of the meshes, little-endian. The header refers to arrays as
/// [offset in bytes, count].
std::string StageFile(const Stage& stage);

}  // namespace tera
