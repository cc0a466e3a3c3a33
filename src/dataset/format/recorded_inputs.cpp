#include "dataset/format/recorded_inputs.h"

#include <fmt/format.h>

#include <optional>

#include "core/config/portable_name.h"
#include "core/error.h"
#include "dataset/files/file_digest.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kDigits = 64;
constexpr double kMostBytes = 9e15;  ///< below 2^53, so that every YAML reader represents it
                                     ///< exactly

bool IsDigest(const std::string& text) {
  return text.size() == kDigits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::string Shown(std::int64_t bytes, const std::string& sha256) {
  constexpr std::size_t kShownDigits = 12;
  return fmt::format("{} bytes with SHA-256 {}...", bytes, sha256.substr(0, kShownDigits));
}

/// The fault of the file at `path`; nullopt if it matches the recorded input.
std::optional<InputFault> FaultOf(const RecordedInput& input, const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) {
    return InputFault(FaultKind::kUnreadable, fmt::format("is missing; need the recorded file, {}",
                                                          Shown(input.bytes, input.sha256)));
  }
  const FileDigest now = DigestOf(path);
  if (now.bytes == input.bytes && now.sha256 == input.sha256) return std::nullopt;
  return InputFault(FaultKind::kInconsistent,
                    fmt::format("differs from the recorded file: found {}, need {}",
                                Shown(now.bytes, now.sha256), Shown(input.bytes, input.sha256)));
}

}  // namespace

std::vector<RecordedInput> DigestsOf(const std::vector<InputFile>& files) {
  std::vector<RecordedInput> inputs;
  for (const InputFile& file : files) {
    const FileDigest digest = DigestOf(file.path);
    inputs.push_back({file.name, digest.bytes, digest.sha256, ""});
  }
  return inputs;
}

std::vector<RecordedInput> ReadInputs(const ConfigMap& config) {
  std::vector<RecordedInput> inputs;
  for (const ConfigMap& item : config.List("inputs")) {
    RecordedInput input{.name = item.Text("file"),
                        .bytes = item.Integer("bytes", Between(0, kMostBytes, "")),
                        .sha256 = item.Text("sha256"),
                        .place = item.Place()};
    if (!IsDigest(input.sha256)) {
      item.Fault("sha256", {FaultKind::kMalformed,
                            fmt::format("'{}' is not a digest, need {} digits of 0-9 and a-f",
                                        input.sha256, kDigits)});
    }
    inputs.push_back(std::move(input));
  }
  return inputs;
}

std::vector<InputFile> RequireInputs(const std::vector<RecordedInput>& inputs,
                                     const std::vector<MovedFiles>& moved,
                                     const std::string& remedy) {
  std::vector<InputFile> files;
  std::vector<InputFault> faults;
  for (const RecordedInput& input : inputs) {
    const fs::path path = PlaceOfInput(input.name, moved);
    files.push_back({input.name, path});
    const std::optional<InputFault> fault = FaultOf(input, path);
    if (!fault) continue;
    const bool elsewhere = path != PlaceOfInput(input.name, {});
    faults.emplace_back(fault->kind,
                        fmt::format("{}{} {}; {}", input.name,
                                    elsewhere ? fmt::format(" (now {})", path.string()) : "",
                                    fault->finding, remedy),
                        input.place);
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  return files;
}

}  // namespace tera
