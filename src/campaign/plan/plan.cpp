#include "campaign/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "campaign/plan/rule_check.h"
#include "core/parse_number.h"
#include "core/random.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/file_digest.h"
#include "dataset/format/dataset_description.h"
#include "dataset/format/recorded_inputs.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr int kSampledEpisodes = 16;  ///< number of episodes loaded during planning

/// Changes the working directory for the lifetime of the object.
class WorkingFolder {
 public:
  explicit WorkingFolder(const fs::path& folder) : before_(fs::current_path()) {
    std::error_code error;
    fs::current_path(folder, error);
    if (!error) return;
    throw InputError(folder.string(),
                     {FaultKind::kUnreadable,
                      fmt::format("holds the campaign's files and cannot be entered ({}); mount it "
                                  "there on this computer too",
                                  error.message())});
  }
  ~WorkingFolder() {
    std::error_code ignored;
    fs::current_path(before_, ignored);
  }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

 private:
  fs::path before_;
};

/// Gives a fault of a campaign value the place of its factor or of `randomise`.
InputFault AtItsPlace(const Campaign& campaign, InputFault fault) {
  constexpr std::string_view kGiven = "--set: ";
  if (!fault.place.starts_with(kGiven)) return fault;
  const std::string path = fault.place.substr(kGiven.size());
  for (const DesignFactor& factor : campaign.factors) {
    if (!factor.key.starts_with(path) && !path.starts_with(factor.key)) continue;
    return {fault.kind, fmt::format("{}: {}", path, fault.finding), factor.place};
  }
  if (path.starts_with("randomise")) fault.place = campaign.randomise_place;
  return fault;
}

LoadedScenario LoadUnder(const Campaign& campaign, const std::vector<std::string>& overrides) {
  const WorkingFolder folder(campaign.folder);
  try {
    return LoadScenario(campaign.scenario, overrides);
  } catch (const InputError& error) {
    std::vector<InputFault> faults;
    for (const InputFault& fault : error.faults()) faults.push_back(AtItsPlace(campaign, fault));
    throw InputError(std::move(faults));
  }
}

/// Digest of the scenario with these overrides, including all files that it names.
std::string ScenarioDigest(const Campaign& campaign, const std::vector<std::string>& overrides) {
  const LoadedScenario loaded = LoadUnder(campaign, overrides);
  std::string text = loaded.resolved_yaml;
  for (const RecordedInput& input : DigestsOf(loaded.scenario.inputs)) {
    text += input.name + input.sha256;
  }
  return Sha256Of(text);
}

std::vector<std::string> OverridesOf(const std::vector<SetValue>& values) {
  std::vector<std::string> overrides;
  for (const SetValue& value : values) overrides.push_back(value.key + "=" + value.yaml);
  return overrides;
}

bool MayNameFile(const std::string& level) {
  return level.find_first_of("./") != std::string::npos && !ParseFinite(level);
}

/// For each "key=level" that may name files, the first episode up to `last` that uses it.
std::map<std::string, int> FirstEpisodes(const Campaign& campaign, int last) {
  std::set<std::string> wanted;
  for (const DesignFactor& factor : campaign.factors) {
    for (const std::string& level : factor.levels) {
      if (MayNameFile(level)) wanted.insert(factor.key + "=" + level);
    }
  }
  std::map<std::string, int> first;
  for (int number = 0; number <= last && first.size() < wanted.size(); ++number) {
    for (const std::string& level : OverridesOf(DesignPoint(campaign, number))) {
      if (wanted.contains(level)) first.try_emplace(level, number);
    }
  }
  return first;
}

/// Digest of the scenario with an episode's factor values, before the draws of `randomise`.
std::string PointDigest(const Campaign& campaign, int number) {
  return ScenarioDigest(campaign, OverridesOf(DesignPoint(campaign, number)));
}

/// The digest of a level is that of the first episode that uses it, because other combinations of
/// values may be invalid.
std::map<std::string, std::string> LevelDigests(const Campaign& campaign) {
  std::map<std::string, std::string> digests;
  for (const auto& [level, number] : FirstEpisodes(campaign, campaign.episodes - 1)) {
    digests[level] = PointDigest(campaign, number);
  }
  return digests;
}

std::string Fingerprint(const Campaign& campaign, std::string text,
                        const std::map<std::string, std::string>& level_digests) {
  text += ScenarioDigest(campaign, {});
  for (const auto& [level, digest] : level_digests) text += level + digest;
  return Sha256Of(text);
}

std::string EpisodesCsv(const Campaign& campaign) {
  std::string text = "number,seed";
  for (const DesignFactor& factor : campaign.factors) text += "," + CsvField(factor.key);
  text += '\n';
  for (int number = 0; number < campaign.episodes; ++number) {
    text += fmt::format("{},{}", number, EpisodeSeed(campaign, number, 0));
    for (const SetValue& value : DesignPoint(campaign, number)) {
      text += "," + CsvField(value.yaml);
    }
    text += '\n';
  }
  return text;
}

void CheckSampled(const Campaign& campaign) {
  const int count = std::min(campaign.episodes, kSampledEpisodes);
  RuleCheck rules(campaign);
  for (int k = 0; k < count; ++k) {
    const auto number = static_cast<int>(std::int64_t{k} * campaign.episodes / count);
    rules.Look(EpisodeScenario(campaign, number, 0).scenario);
  }
  rules.Finish();
}

struct PlanText {
  std::string version, fingerprint, folder;
  std::map<std::string, std::string> level_digests;
};

std::string Yaml(const PlanText& text) {
  std::string yaml =
      fmt::format("tera_version: {}\nfingerprint: {}\nfolder: {}\n", YamlQuoted(text.version),
                  YamlQuoted(text.fingerprint), YamlQuoted(text.folder));
  if (!text.level_digests.empty()) yaml += "levels:\n";
  for (const auto& [level, digest] : text.level_digests) {
    yaml += fmt::format("  {}: {}\n", YamlQuoted(level), YamlQuoted(digest));
  }
  return yaml;
}

PlanText ReadPlanText(const fs::path& file) {
  if (!fs::exists(file)) {
    throw InputError(file.string(), {FaultKind::kUnreadable,
                                     "is missing; need the folder of a campaign that `tera "
                                     "campaign plan CAMPAIGN.yaml --out DIR` makes"});
  }
  const Config config = Config::FromFile(file);
  PlanText text{config.root().Text("tera_version"),
                config.root().Text("fingerprint"),
                config.root().Text("folder"),
                {}};
  if (const auto levels = config.root().OptionalMap("levels")) {
    for (const std::string& level : levels->Keys()) {
      text.level_digests[level] = levels->Text(level);
    }
  }
  config.Finish();
  if (text.version != TeraVersion()) {
    throw InputError(file.string(),
                     {FaultKind::kInconsistent,
                      fmt::format("planned by TERA {}, but this is {}; use that version on every "
                                  "computer, or plan anew in another folder",
                                  text.version, TeraVersion())});
  }
  return text;
}

Campaign ReadFrom(const Config& config, const fs::path& folder) {
  Campaign campaign = ReadCampaign(config.root());
  config.Finish();
  campaign.folder = folder;
  campaign.scenario = fs::absolute(campaign.scenario);
  return campaign;
}

}  // namespace

std::string CsvField(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + '"';
}

std::string EpisodeName(int number) { return fmt::format("{:06}", number); }

fs::path Plan::EpisodeFolder(int number) const { return folder / "episodes" / EpisodeName(number); }
fs::path Plan::WorkFolder(int number) const { return folder / "work" / EpisodeName(number); }
fs::path Plan::FailureFile(int number) const {
  return folder / "failed" / (EpisodeName(number) + ".yaml");
}
fs::path Plan::LogFile(int number) const {
  return folder / "logs" / (EpisodeName(number) + ".log");
}

Plan MakePlan(const fs::path& file, const fs::path& out) {
  const fs::path folder = fs::absolute(out).lexically_normal(),
                 of_file = fs::absolute(file).parent_path().lexically_normal();
  const std::string text = ReadWholeFile(file);
  Plan plan{folder, "", {}, ReadFrom(Config::FromFile(file), of_file)};
  plan.level_digests = LevelDigests(plan.campaign);
  plan.fingerprint = Fingerprint(plan.campaign, text, plan.level_digests);
  if (fs::exists(folder / "plan.yaml")) {
    if (ReadPlanText(folder / "plan.yaml").fingerprint == plan.fingerprint) return plan;
    throw InputError(
        folder.string(),
        {FaultKind::kInconsistent, fmt::format("holds another campaign than {}; give each campaign "
                                               "its own folder, or restore campaign and scenario",
                                               file.string())});
  }
  const fs::path copy = folder / "campaign.yaml";
  if (fs::exists(copy) && ReadWholeFile(copy) != text) {
    throw InputError(copy.string(), {FaultKind::kInconsistent,
                                     fmt::format("is another campaign than {}, and planning would "
                                                 "replace it; name another folder with --out",
                                                 file.string())});
  }
  CheckSampled(plan.campaign);
  for (const char* name : {"episodes", "work", "failed", "logs"}) {
    MakeWritableFolder(folder / name);
  }
  WriteWholeFile(folder / "campaign.yaml", text);
  WriteWholeFile(folder / "episodes.csv", EpisodesCsv(plan.campaign));
  WriteWholeFile(folder / "plan.yaml", Yaml({std::string(TeraVersion()), plan.fingerprint,
                                             of_file.string(), plan.level_digests}));
  return plan;
}

Plan LoadPlan(const fs::path& out) {
  const fs::path folder = fs::absolute(out).lexically_normal();
  const PlanText text = ReadPlanText(folder / "plan.yaml");
  const fs::path file = folder / "campaign.yaml";
  const WorkingFolder of_file(text.folder);
  return {folder, text.fingerprint, text.level_digests,
          ReadFrom(Config::FromText(ReadWholeFile(file), file), text.folder)};
}

void RequireSameScenario(const Plan& plan, int number) {
  const auto fail = [&](const std::string& place, const std::string& finding) {
    throw InputError(
        place,
        {FaultKind::kInconsistent,
         fmt::format("{} since {} was planned; restore the files, or plan anew in another folder",
                     finding, plan.folder.string())});
  };
  const std::string text = ReadWholeFile(plan.folder / "campaign.yaml");
  if (Fingerprint(plan.campaign, text, plan.level_digests) != plan.fingerprint) {
    fail(plan.campaign.scenario.string(), "has changed, or its inputs have changed,");
  }
  if (plan.level_digests.empty()) return;
  const std::map<std::string, int> first = FirstEpisodes(plan.campaign, number);
  const std::vector<SetValue> values = DesignPoint(plan.campaign, number);
  for (std::size_t f = 0; f < values.size(); ++f) {
    const std::string level = values[f].key + "=" + values[f].yaml;
    const auto planned = plan.level_digests.find(level);
    if (planned == plan.level_digests.end()) continue;
    if (PointDigest(plan.campaign, first.at(level)) == planned->second) continue;
    fail(plan.campaign.factors[f].place,
         fmt::format("files of level {} have changed", values[f].yaml));
  }
}

std::uint64_t EpisodeSeed(const Campaign& campaign, int number, int draw) {
  constexpr std::uint64_t kMost = (std::uint64_t{1} << 52) - 1;
  const std::string name = fmt::format("{}/{}/{}/{}", campaign.name, campaign.seed, number, draw);
  return HashText(Sha256Of(name)) & kMost;
}

LoadedScenario EpisodeScenario(const Campaign& campaign, int number, int draw) {
  std::vector<std::string> overrides;
  if (!campaign.randomise.empty()) overrides.push_back("randomise=" + campaign.randomise);
  for (std::string& value : OverridesOf(DesignPoint(campaign, number))) {
    overrides.push_back(std::move(value));
  }
  overrides.push_back(fmt::format("seed={}", EpisodeSeed(campaign, number, draw)));
  return LoadUnder(campaign, overrides);
}

}  // namespace tera
