#include "campaign/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "campaign/plan/rule_check.h"
#include "core/random.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/file_digest.h"
#include "dataset/format/dataset_description.h"
#include "dataset/format/recorded_inputs.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr int kSampledEpisodes = 16;  ///< loaded in planning

/// Digest of the scenario without the campaign's values.
std::string ScenarioDigest(const fs::path& scenario) {
  const LoadedScenario loaded = LoadScenario(scenario, {});
  std::string text = loaded.resolved_yaml;
  for (const RecordedInput& input : DigestsOf(loaded.scenario.inputs)) {
    text += input.name + input.sha256;
  }
  return Sha256Of(text);
}

/// A fault of a value of the campaign gets the place of its factor or randomise:.
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

std::string EpisodesCsv(const Campaign& campaign) {
  std::string text = "number,seed";
  for (const DesignFactor& factor : campaign.factors) text += "," + factor.key;
  text += '\n';
  for (int number = 0; number < campaign.episodes; ++number) {
    text += fmt::format("{},{}", number, EpisodeSeed(campaign, number, 0));
    for (const SetValue& value : DesignPoint(campaign, number)) {
      const bool is_plain = value.yaml.find_first_of(",\"\n") == std::string::npos;
      text += is_plain ? "," + value.yaml : fmt::format(",\"{}\"", value.yaml);
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
};

std::string Yaml(const PlanText& text) {
  return fmt::format("tera_version: {}\nfingerprint: {}\nfolder: {}\n", YamlQuoted(text.version),
                     YamlQuoted(text.fingerprint), YamlQuoted(text.folder));
}

PlanText ReadPlanText(const fs::path& file) {
  if (!fs::exists(file)) {
    throw InputError(file.string(), {FaultKind::kUnreadable,
                                     "is not there; need the folder of a campaign, which `tera "
                                     "campaign plan CAMPAIGN.yaml --out DIR` makes"});
  }
  const Config config = Config::FromFile(file);
  PlanText text{config.root().Text("tera_version"), config.root().Text("fingerprint"),
                config.root().Text("folder")};
  config.Finish();
  if (text.version != TeraVersion()) {
    throw InputError(file.string(),
                     {FaultKind::kInconsistent,
                      fmt::format("planned by TERA {}, and this is {}; go on with that version on "
                                  "every computer, or plan anew in another folder",
                                  text.version, TeraVersion())});
  }
  return text;
}

Campaign ReadFrom(const Config& config) {
  Campaign campaign = ReadCampaign(config.root());
  config.Finish();
  return campaign;
}

}  // namespace

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
  Plan plan{folder, "", ReadFrom(Config::FromFile(file))};
  const fs::path scenario = fs::absolute(plan.campaign.scenario);
  plan.campaign.scenario = scenario;
  fs::current_path(of_file);
  plan.fingerprint = Sha256Of(text + ScenarioDigest(scenario));
  if (fs::exists(folder / "plan.yaml")) {
    if (ReadPlanText(folder / "plan.yaml").fingerprint == plan.fingerprint) return plan;
    throw InputError(folder.string(),
                     {FaultKind::kInconsistent,
                      fmt::format("holds another campaign than {} is now; give each campaign a "
                                  "folder of its own, or put campaign and scenario back as they "
                                  "were",
                                  file.string())});
  }
  const fs::path copy = folder / "campaign.yaml";
  if (fs::exists(copy) && ReadWholeFile(copy) != text) {
    throw InputError(copy.string(), {FaultKind::kInconsistent,
                                     fmt::format("is another campaign than {}, and planning would "
                                                 "replace it; name another folder by --out",
                                                 file.string())});
  }
  CheckSampled(plan.campaign);
  for (const char* name : {"episodes", "work", "failed", "logs"}) {
    MakeWritableFolder(folder / name);
  }
  WriteWholeFile(folder / "campaign.yaml", text);
  WriteWholeFile(folder / "episodes.csv", EpisodesCsv(plan.campaign));
  WriteWholeFile(folder / "plan.yaml",
                 Yaml({std::string(TeraVersion()), plan.fingerprint, of_file.string()}));
  return plan;
}

Plan LoadPlan(const fs::path& out) {
  const fs::path folder = fs::absolute(out).lexically_normal();
  const PlanText text = ReadPlanText(folder / "plan.yaml");
  std::error_code error;
  fs::current_path(text.folder, error);
  if (error) {
    throw InputError((folder / "plan.yaml").string(),
                     {FaultKind::kUnreadable,
                      fmt::format("the campaign's files are in {}, which cannot be entered ({}); "
                                  "mount it there on this computer too",
                                  text.folder, error.message())});
  }
  const fs::path file = folder / "campaign.yaml";
  Plan plan{folder, text.fingerprint, ReadFrom(Config::FromText(ReadWholeFile(file), file))};
  plan.campaign.scenario = fs::absolute(plan.campaign.scenario);
  return plan;
}

void RequireSameScenario(const Plan& plan) {
  const std::string text = ReadWholeFile(plan.folder / "campaign.yaml");
  if (Sha256Of(text + ScenarioDigest(plan.campaign.scenario)) == plan.fingerprint) return;
  throw InputError(plan.campaign.scenario.string(),
                   {FaultKind::kInconsistent,
                    fmt::format("is another scenario, or has other inputs, than when {} was "
                                "planned; put the files back, or plan anew in another folder",
                                plan.folder.string())});
}

std::uint64_t EpisodeSeed(const Campaign& campaign, int number, int draw) {
  constexpr std::uint64_t kMost = (std::uint64_t{1} << 52) - 1;
  const std::string name = fmt::format("{}/{}/{}/{}", campaign.name, campaign.seed, number, draw);
  return HashText(Sha256Of(name)) & kMost;
}

LoadedScenario EpisodeScenario(const Campaign& campaign, int number, int draw) {
  std::vector<std::string> overrides;
  if (!campaign.randomise.empty()) overrides.push_back("randomise=" + campaign.randomise);
  for (const SetValue& value : DesignPoint(campaign, number)) {
    overrides.push_back(value.key + "=" + value.yaml);
  }
  overrides.push_back(fmt::format("seed={}", EpisodeSeed(campaign, number, draw)));
  try {
    return LoadScenario(campaign.scenario, overrides);
  } catch (const InputError& error) {
    std::vector<InputFault> faults;
    for (const InputFault& fault : error.faults()) {
      faults.push_back(AtItsPlace(campaign, fault));
    }
    throw InputError(std::move(faults));
  }
}

}  // namespace tera
