#pragma once

#include <string>

#include "view/stage.h"

namespace tera {

/// Encodes a stage for web/src/stage/stage_file.js: "TSTG", length of the header as a 32-bit
/// number, JSON header, and the mesh arrays in little-endian order. The header refers to an array
/// as [offset in bytes, count].
std::string StageFile(const Stage& stage);

}  // namespace tera
