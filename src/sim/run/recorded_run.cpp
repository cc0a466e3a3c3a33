#include "sim/run/recorded_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "core/config/portable_name.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/recorded_inputs.h"
#include "dataset/format/recording.h"
#include "dataset/format/writer.h"
#include "sim/run/replay.h"

namespace tera {
namespace {

MovedFiles Moved(const std::string& text, const std::vector<RecordedInput>& inputs) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size()) {
    throw InputError("--moved " + text,
                     {FaultKind::kMalformed, "need OLD=NEW, each a file or a folder"});
  }
  MovedFiles moved{text.substr(0, equals), text.substr(equals + 1)};
  if (std::none_of(inputs.begin(), inputs.end(),
                   [&](const RecordedInput& input) { return Concerns(moved, input.name); })) {
    throw InputError("--moved " + text,
                     {FaultKind::kNoSuchName,
                      fmt::format("no input of the recording is '{}' or below it; need a name that "
                                  "dataset.yaml lists, or the folder of such a name",
                                  moved.from)});
  }
  return moved;
}

/// Throws unless all files of `read` are among the checked ones. Which mesh a URDF refers to also
/// depends on the folders around it, so another file may have been read.
void RequireAmong(const std::vector<InputFile>& checked, const std::vector<InputFile>& read,
                  const std::filesystem::path& scenario_file) {
  std::set<std::string> known;
  for (const InputFile& input : checked) known.insert(PortableName(input.path));
  for (const InputFile& file : read) {
    const std::string name = PortableName(file.path);
    if (known.contains(name)) continue;
    throw InputError(scenario_file.string(),
                     fmt::format("reads {}, which the recorded run did not read; move it away, or "
                                 "give the place of the recorded files with --moved OLD=NEW",
                                 name));
  }
}

/// The recording's scenario from unchanged input files. Inputs keep their recorded names even if
/// they have moved.
LoadedScenario ScenarioOf(const std::filesystem::path& recording,
                          const std::vector<std::string>& overrides,
                          const std::vector<std::string>& moved_texts) {
  const std::filesystem::path scenario_file = recording / "scenario.yaml";
  const std::vector<RecordedInput> recorded = LoadInputs(recording);
  std::vector<MovedFiles> moved;
  for (const std::string& text : moved_texts) moved.push_back(Moved(text, recorded));
  std::vector<InputFile> inputs =
      RequireInputs(recorded, moved, "restore that file, or give its place with --moved OLD=NEW");
  LoadedScenario loaded = LoadScenario(scenario_file, overrides, {}, moved);
  if (overrides.empty()) loaded.resolved_yaml = ReadWholeFile(scenario_file);
  if (!recorded.empty()) {
    RequireAmong(inputs, loaded.scenario.inputs, scenario_file);
    loaded.scenario.inputs = std::move(inputs);
  }
  return loaded;
}

bool IsAt(const std::filesystem::path& folder, const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::equivalent(folder, path, ignored);
}

/// Resolves symbolic links and `..`. The path need not exist.
bool IsInside(const std::filesystem::path& folder, const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path above = std::filesystem::weakly_canonical(path, error);
  while (!error && above.has_relative_path()) {
    above = above.parent_path();
    if (IsAt(folder, above)) return true;
  }
  return false;
}

}  // namespace

LoadedScenario LoadRecordedScenario(const std::filesystem::path& directory,
                                    const std::vector<std::string>& overrides,
                                    const std::vector<std::string>& moved) {
  const Recording recording(directory);
  RequireSimulated(recording);
  LoadedScenario loaded = ScenarioOf(directory, overrides, moved);
  // A run whose task was completed may have ended before its planned duration.
  if (loaded.scenario.task) {
    loaded.scenario.duration_s = std::min(loaded.scenario.duration_s, recording.info().duration_s);
  }
  return loaded;
}

LoadedScenario LoadRecordedRun(const std::filesystem::path& directory,
                               const std::vector<std::string>& moved) {
  if (WasStopped(directory)) {
    LoadedScenario loaded = ScenarioOf(directory, {}, moved);
    CommandAsFarAsRecorded(directory, &loaded.scenario);
    return loaded;
  }
  const Recording recording(directory);
  RequireSimulated(recording);
  LoadedScenario loaded = ScenarioOf(directory, {}, moved);
  CommandAsRecorded(recording, &loaded.scenario);
  return loaded;
}

void RequireAnotherPlace(const std::filesystem::path& recording, const std::filesystem::path& out) {
  for (const std::filesystem::path& written : {out, IncompleteOf(out)}) {
    if (IsAt(recording, written)) {
      throw InputError(
          "--out " + out.string(),
          {FaultKind::kUnwritable,
           fmt::format("would be written to {}, the recording to replay; give it another name",
                       written.string())});
    }
    if (IsInside(recording, written)) {
      throw InputError(
          "--out " + out.string(),
          {FaultKind::kUnwritable,
           fmt::format("lies inside {}, the recording to replay; choose a folder outside it",
                       recording.string())});
    }
  }
}

}  // namespace tera
