#pragma once

#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/config/input_file.h"
#include "dataset/format/dataset_info.h"

namespace tera {

/// Size and SHA-256 of each file. Throws InputError if a file cannot be read.
std::vector<RecordedInput> DigestsOf(const std::vector<InputFile>& files);

/// Reads the key `inputs`. Faults are reported at `config`.
std::vector<RecordedInput> ReadInputs(const ConfigMap& config);

/// Finds the inputs of a recording on this computer. Throws InputError if any is missing or has
/// changed. The message names each of them and ends with the advice `remedy`.
std::vector<InputFile> RequireInputs(const std::vector<RecordedInput>& inputs,
                                     const std::vector<MovedFiles>& moved,
                                     const std::string& remedy);

}  // namespace tera
