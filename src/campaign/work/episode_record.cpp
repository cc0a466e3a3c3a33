#include "campaign/work/episode_record.h"

#include <fmt/format.h>

#include <array>
#include <new>

#include "core/config/config.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/dataset_description.h"

namespace tera {
namespace {

struct ReasonName {
  FailureReason reason;
  std::string_view name;
};
constexpr std::array<ReasonName, 5> kReasons = {{{FailureReason::kBadInput, "bad_input"},
                                                 {FailureReason::kRefused, "refused"},
                                                 {FailureReason::kBug, "bug"},
                                                 {FailureReason::kMemory, "memory"},
                                                 {FailureReason::kKilled, "killed"}}};

}  // namespace

std::string NameOf(FailureReason reason) {
  return std::string(kReasons[static_cast<std::size_t>(reason)].name);
}

FailureReason ReasonOf(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return FailureReason::kMemory;
  return dynamic_cast<const InputError*>(&error) != nullptr ? FailureReason::kBadInput
                                                            : FailureReason::kBug;
}

bool IsWorthRetry(FailureReason reason) {
  return reason == FailureReason::kKilled || reason == FailureReason::kMemory;
}

void WriteRecord(const EpisodeRecord& record, const std::filesystem::path& file) {
  std::string values, refused;
  for (const auto& [key, yaml] : record.values) {
    values +=
        fmt::format("{}{}: {}", values.empty() ? "" : ", ", YamlQuoted(key), YamlQuoted(yaml));
  }
  for (const std::string& rule : record.refused) {
    refused += (refused.empty() ? "" : ", ") + YamlQuoted(rule);
  }
  WriteWholeFile(
      file,
      fmt::format("fingerprint: {}\nnumber: {}\ndraw: {}\nseed: {}\nvalues: {{{}}}\n"
                  "refused: [{}]\nsha256: {}\nbytes: {}\nframes: {}\nsimulated_s: {}\n"
                  "wall_s: {:.2f}\npeak_mb: {:.1f}\nhost: {}\n",
                  YamlQuoted(record.fingerprint), record.number, record.draw, record.seed, values,
                  refused, YamlQuoted(record.sha256), record.bytes, record.frames,
                  record.simulated_s, record.wall_s, record.peak_mb, YamlQuoted(record.host)));
}

EpisodeRecord ReadRecord(const std::filesystem::path& file) {
  constexpr double kMost = 9e15;  // integers below this are exact in doubles
  const Config config = Config::FromFile(file);
  const ConfigMap root = config.root();
  EpisodeRecord record;
  record.fingerprint = root.Text("fingerprint");
  record.number = static_cast<int>(root.Integer("number", Between(0, 1e9, "")));
  record.draw = static_cast<int>(root.Integer("draw", Between(0, 1e9, "")));
  record.seed = static_cast<std::uint64_t>(root.Integer("seed", Between(0, kMost, "")));
  const ConfigMap values = root.Map("values");
  for (const std::string& key : values.Keys()) record.values[key] = values.Text(key);
  record.refused = root.Texts("refused");
  record.sha256 = root.Text("sha256");
  record.bytes = root.Integer("bytes", Between(0, kMost, ""));
  record.frames = root.Integer("frames", Between(0, kMost, ""));
  record.simulated_s = root.Number("simulated_s", AtLeast(0, "s"));
  record.wall_s = root.Number("wall_s", AtLeast(0, "s"));
  record.peak_mb = root.Number("peak_mb", AtLeast(0, "MB"));
  record.host = root.Text("host");
  config.Finish();
  return record;
}

void WriteFailure(const Failure& failure, const std::filesystem::path& file) {
  WriteWholeFile(file, fmt::format("reason: {}\nmessage: {}\n", NameOf(failure.reason),
                                   YamlQuoted(failure.message)));
}

Failure ReadFailure(const std::filesystem::path& file) {
  const Config config = Config::FromFile(file);
  const std::string name =
      config.root().Choice("reason", {"bad_input", "refused", "bug", "memory", "killed"});
  Failure failure{FailureReason::kBug, config.root().Text("message")};
  config.Finish();
  for (const ReasonName& known : kReasons) {
    if (known.name == name) failure.reason = known.reason;
  }
  return failure;
}

}  // namespace tera
