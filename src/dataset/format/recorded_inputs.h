#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/config/input_file.h"

namespace tera {

/// A file that a recording was made from besides its scenario.yaml, and what was in it.
struct RecordedInput {
  std::string name;  ///< PortableName
  std::int64_t bytes = 0;
  std::string sha256;  ///< 64 hexadecimal digits
  std::string place;   ///< where it stands, "run/dataset.yaml:9:5: inputs[0]"; empty of a new one
};

/// Where a recording has its inputs until its dataset.yaml is written.
inline constexpr char kInputsOfStoppedName[] = "INCOMPLETE.inputs";

/// What is in these files. Throws InputError where one cannot be read.
std::vector<RecordedInput> DigestsOf(const std::vector<InputFile>& files);

/// The key `inputs` and its list, as dataset.yaml has them.
std::string InputsYaml(const std::vector<RecordedInput>& inputs);

/// What stands at the key `inputs`. Faults go to `config`.
std::vector<RecordedInput> ReadInputs(const ConfigMap& config);

/// The inputs of a recording, whole or stopped; empty where it does not name them.
std::vector<RecordedInput> LoadInputs(const std::filesystem::path& directory);

/// Where the inputs are read now. Throws InputError that names every one that is missing or is no
/// longer what was recorded, with what to do about it, `remedy`.
std::vector<InputFile> RequireInputs(const std::vector<RecordedInput>& inputs,
                                     const std::vector<MovedFiles>& moved,
                                     const std::string& remedy);

}  // namespace tera
