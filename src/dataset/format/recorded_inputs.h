#pragma once

#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/config/input_file.h"
#include "dataset/format/dataset_info.h"

namespace tera {

/// What is in these files. Throws InputError where one cannot be read.
std::vector<RecordedInput> DigestsOf(const std::vector<InputFile>& files);

/// What stands at the key `inputs`. Faults go to `config`.
std::vector<RecordedInput> ReadInputs(const ConfigMap& config);

/// Where the inputs are read now. Throws InputError that names every one that is missing or is no
/// longer what was recorded, with what to do about it, `remedy`.
std::vector<InputFile> RequireInputs(const std::vector<RecordedInput>& inputs,
                                     const std::vector<MovedFiles>& moved,
                                     const std::string& remedy);

}  // namespace tera
