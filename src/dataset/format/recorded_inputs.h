#pragma once

#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/config/input_file.h"
#include "dataset/format/dataset_info.h"

namespace tera {

/// Digests of these files. Throws InputError if one cannot be read.
std::vector<RecordedInput> DigestsOf(const std::vector<InputFile>& files);

/// Reads the key `inputs`. Faults go to `config`.
std::vector<RecordedInput> ReadInputs(const ConfigMap& config);

/// Current paths of the inputs. Throws InputError that names every missing or changed input, with
/// the advice `remedy`.
std::vector<InputFile> RequireInputs(const std::vector<RecordedInput>& inputs,
                                     const std::vector<MovedFiles>& moved,
                                     const std::string& remedy);

}  // namespace tera
