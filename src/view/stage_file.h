#pragma once

#include <string>

#include "view/stage.h"

namespace tera {

/// The bytes of a stage as web/src/stage/stage_file.js reads them: "TSTG", the length of a header
/// as a 32-bit number, the header in JSON, and the arrays of meshes, little-endian, to which the
/// header points as [offset in bytes, count].
std::string StageFile(const Stage& stage);

}  // namespace tera
