#include "campaign/merge/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "campaign/merge/distributions.h"
#include "campaign/merge/splits.h"
#include "campaign/work/index.h"
#include "core/error.h"
#include "dataset/export/export.h"
#include "dataset/export/webdataset/merged_archives.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/whole_folder.h"
#include "dataset/format/recording.h"
#include "sim/joint_trees.h"
#include "sim/recorded_ground.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

fs::path DatasetOf(const Plan& plan, int number) { return plan.EpisodeFolder(number) / "data"; }

void RequireAllMade(const Plan& plan, const CampaignState& state) {
  if (state.missing.empty() && !state.done.empty()) return;
  throw InputError(plan.folder.string(),
                   {FaultKind::kMissing,
                    fmt::format("{} of {} episodes are still to be made; run `tera campaign run` "
                                "first",
                                plan.campaign.episodes - static_cast<int>(state.done.size()),
                                plan.campaign.episodes)});
}

/// Checks every episode with lint. Returns the sum of their statistics.
DatasetStatistics LintAll(const Plan& plan, const CampaignState& state,
                          const MergeOptions& options) {
  DatasetStatistics sum;
  int done = 0;
  for (const auto& [number, _] : state.done) {
    const LintReport report = Lint(DatasetOf(plan, number), {.every_frame = options.every_frame});
    for (const LintFinding& finding : report.findings) {
      if (finding.rule->severity != Severity::kError) continue;
      throw InputError((DatasetOf(plan, number) / finding.channel).string(),
                       {FaultKind::kMalformed,
                        fmt::format("breaks the rule {}: {}; delete {} and run the campaign again",
                                    finding.rule->id, finding.places.front().message,
                                    plan.EpisodeFolder(number).string())});
    }
    AddCounts(report.statistics, &sum);
    if (options.progress) options.progress(++done, static_cast<int>(state.done.size()));
  }
  return sum;
}

void ExportAll(const Plan& plan, const std::map<int, std::string>& parts, const fs::path& folder) {
  for (const std::string& name : plan.campaign.outputs.exports) {
    ExportOptions options;
    for (const ExportFormatName& known : kExportFormats) {
      if (known.name == name) options.format = known.format;
    }
    for (const auto& [number, part] : parts) {
      const fs::path dataset = DatasetOf(plan, number);
      options.joint_trees = [&] { return RecordedJointTrees(dataset, {}); };
      if (IsBag(options.format)) options.read_ground = ReaderOfGround(Recording(dataset).info());
      const fs::path out = folder / name / part / EpisodeName(number);
      MakeFolder(out.parent_path());
      Export(dataset, out, options);
    }
  }
}

std::string SplitsCsv(const CampaignState& state, const std::map<int, std::string>& parts) {
  std::string text = "episode,part,sha256\n";
  for (const auto& [number, record] : state.done) {
    text += fmt::format("{},{},{}\n", EpisodeName(number), parts.at(number), record.sha256);
  }
  return text;
}

std::string Card(const Plan& plan, const CampaignState& state, const DatasetStatistics& contents,
                 std::string beginning) {
  if (beginning.empty()) beginning = fmt::format("# {}\n", plan.campaign.name);
  return fmt::format(
      "{}\n{} episodes of campaign `{}`, fingerprint {}. `splits.csv` has the part and the digest "
      "of "
      "each.\n\n## Values\n\n{}\n## Contents\n\n{}",
      beginning, state.done.size(), plan.campaign.name, plan.fingerprint, ValuesTable(state),
      ContentsTable(contents));
}

}  // namespace

MergeReport Merge(const Plan& plan, const MergeOptions& options) {
  RequireNothingAt(options.out);
  const CampaignState state = RefreshIndex(plan);
  RequireAllMade(plan, state);
  const std::map<int, std::string> parts = PartsOf(plan.campaign, state.done);
  const DatasetStatistics contents = LintAll(plan, state, options);
  WholeFolder folder(options.out);
  std::vector<MergedEpisode> episodes;
  bool has_frames = false;
  for (const auto& [number, record] : state.done) {
    episodes.push_back({EpisodeName(number), DatasetOf(plan, number), parts.at(number)});
    has_frames = has_frames || record.frames > 0;
  }
  const CampaignOutputs& outputs = plan.campaign.outputs;
  std::string card;
  if (has_frames) {
    DatasetInfo about;
    about.scenario_name = plan.campaign.name;
    about.seed = plan.campaign.seed;
    card = WriteMergedArchives(episodes, folder.temporary(),
                               {outputs.sensors, outputs.shard_bytes, outputs.card, about});
  }
  ExportAll(plan, parts, folder.temporary());
  WriteWholeFile(folder.temporary() / "splits.csv", SplitsCsv(state, parts));
  WriteWholeFile(folder.temporary() / "README.md", Card(plan, state, contents, std::move(card)));
  MergeReport report{.episodes = static_cast<int>(state.done.size()),
                     .left_out = static_cast<int>(state.failed.size())};
  for (const auto& [_, part] : parts) ++report.of_part[part];
  for (const auto& entry : fs::recursive_directory_iterator(folder.temporary())) {
    if (!entry.is_regular_file()) continue;
    report.archives += entry.path().extension() == ".tar";
    report.bytes += static_cast<std::int64_t>(entry.file_size());
  }
  folder.Commit();
  return report;
}

}  // namespace tera
