#include "campaign/plan/campaign.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "core/config/fault_text.h"
#include "core/config/plain_name.h"

namespace tera {
namespace {

constexpr double kMostEpisodes = 1'000'000, kMostRedraws = 1000, kMostSeed = 9e15;
constexpr std::int64_t kBytesPerMb = 1'000'000;
constexpr double kMostShardMb = 1000;

DesignFactor ReadFactor(const ConfigMap& entry, Design design) {
  DesignFactor factor{.key = entry.Text("key"), .place = entry.Place("key")};
  const bool has_levels = entry.Has("levels"), has_range = entry.Has("range");
  if (has_levels == has_range) {
    entry.Fault("", {FaultKind::kMissing, "need either levels: [...] or range: [least, most]"});
    return factor;
  }
  if (has_levels) {
    factor.levels = entry.YamlItems("levels");
    if (factor.levels.empty()) entry.Fault("levels", {FaultKind::kMissing, "need one or more"});
    return factor;
  }
  if (design == Design::kFull) {
    entry.Fault("range",
                "a full factorial has levels; write levels: [...], or choose the design "
                "latin_hypercube or sobol");
  }
  factor.is_log = entry.Choice("scale", {"linear", "log"}, "linear") == "log";
  const std::vector<double> ends =
      entry.Numbers("range", factor.is_log ? Positive("") : Any(""), 2, 2);
  if (ends.size() == 2) {
    factor.least = ends[0];
    factor.most = ends[1];
    if (ends[1] <= ends[0]) {
      entry.Fault("range", {FaultKind::kOutOfRange, "need [least, most], least < most"});
    }
  }
  return factor;
}

SeenShare ReadSeen(const ConfigMap& entry) {
  SeenShare seen;
  const std::string name = entry.Text("seen");
  if (const auto label = SemanticClassFromName(name)) {
    seen.label = *label;
  } else {
    std::vector<std::string> names;
    for (const SemanticClassInfo& info : kSemanticClasses) names.emplace_back(info.name);
    entry.Fault("seen", fault::NotKnown(name, names));
  }
  seen.camera = entry.Text("camera", "");
  seen.visible_px = static_cast<int>(entry.Integer("visible_px", Between(1, 1e9, "px"), 1));
  return seen;
}

TableColumn ReadColumn(const ConfigMap& entry) {
  const std::string figure = entry.Choice("of", {"largest", "least", "mean", "last"}, "largest");
  return {entry.Text("table"), entry.Text("column"),
          figure == "least"  ? ColumnFigure::kLeast
          : figure == "mean" ? ColumnFigure::kMean
          : figure == "last" ? ColumnFigure::kLast
                             : ColumnFigure::kLargest};
}

AcceptanceRule ReadRule(const ConfigMap& entry) {
  AcceptanceRule rule{.name = entry.Text("name"), .figure = SeenShare{}, .place = entry.Place()};
  const int kinds = entry.Has("seen") + entry.Has("table") + entry.Has("tilt_deg_of");
  if (kinds != 1) {
    entry.Fault("", {FaultKind::kMissing, "need one of seen, table, tilt_deg_of"});
  } else if (entry.Has("seen")) {
    rule.figure = ReadSeen(entry);
  } else if (entry.Has("table")) {
    rule.figure = ReadColumn(entry);
  } else {
    rule.figure = LargestTilt{entry.Text("tilt_deg_of")};
  }
  const auto least = entry.OptionalNumber("at_least", Any("")),
             most = entry.OptionalNumber("at_most", Any(""));
  if (least) rule.at_least = *least;
  if (most) rule.at_most = *most;
  if (!least && !most) entry.Fault("", {FaultKind::kMissing, "need at_least or at_most"});
  if (rule.at_least > rule.at_most) {
    entry.Fault("at_most", "no number is in these bounds; need at_least <= at_most");
  }
  if (std::holds_alternative<SeenShare>(rule.figure) && rule.at_least > 1) {
    entry.Fault("at_least",
                {FaultKind::kOutOfRange,
                 fmt::format("{} is not a share of frames, need 0 to 1", rule.at_least)});
  }
  return rule;
}

Splits ReadSplits(const ConfigMap& entry) {
  Splits splits;
  if (entry.Has("by")) splits.by = entry.Texts("by");
  double sum = 0;
  splits.shares = entry.NamedNumbers("shares", {.min = 0, .max = 1, .min_excluded = true});
  for (const auto& [name, share] : splits.shares) {
    RequirePlainName(entry, "shares", name);
    sum += share;
  }
  if (std::abs(sum - 1) > 1e-6) {
    entry.Fault("shares", {FaultKind::kOutOfRange, fmt::format("sum to {}, need 1", sum)});
  }
  return splits;
}

CampaignOutputs ReadOutputs(const ConfigMap& entry) {
  CampaignOutputs outputs;
  if (entry.Has("sensors")) outputs.sensors = entry.Texts("sensors");
  if (entry.Has("export")) outputs.exports = entry.Texts("export");
  std::vector<std::string> known;
  for (const ExportFormatName& format : kExportFormats) known.emplace_back(format.name);
  for (const std::string& format : outputs.exports) {
    if (std::find(known.begin(), known.end(), format) == known.end()) {
      entry.Fault("export", fault::NotKnown(format, known));
    }
  }
  const double shard_mb = entry.Number("shard_mb", Between(1, kMostShardMb, "MB"), kMostShardMb);
  outputs.shard_bytes = std::llround(shard_mb * kBytesPerMb);
  if (const auto card = entry.OptionalFile("card")) outputs.card = *card;
  outputs.keep_state = entry.Boolean("keep_state", false);
  return outputs;
}

SweepOutcome ReadOutcome(const ConfigMap& entry) {
  SweepOutcome outcome{.run = {},
                       .report = entry.Text("report"),
                       .figure = entry.Text("figure"),
                       .place = entry.Place("run"),
                       .report_place = entry.Place("report"),
                       .figure_place = entry.Place("figure")};
  const std::string command = entry.Text("run");
  std::istringstream words(command);
  for (std::string word; words >> word;) outcome.run.push_back(word);
  for (const char* folder : {"{episode}", "{out}"}) {
    if (command.find(folder) != std::string::npos) continue;
    entry.Fault("run", {FaultKind::kMissing,
                        fmt::format("has no {}; need a command of tera on {{episode}} that writes "
                                    "below {{out}}",
                                    folder)});
  }
  return outcome;
}

double CellsOf(const Campaign& campaign) {
  double cells = 1;
  for (const DesignFactor& factor : campaign.factors) {
    cells *= static_cast<double>(std::max<std::size_t>(1, factor.levels.size()));
  }
  return cells;
}

void ReadDesign(const ConfigMap& config, Campaign* campaign) {
  const std::string design = config.Choice("design", {"full", "latin_hypercube", "sobol"}, "full");
  campaign->design = design == "sobol"             ? Design::kSobol
                     : design == "latin_hypercube" ? Design::kLatinHypercube
                                                   : Design::kFull;
  std::set<std::string> keys;
  for (const ConfigMap& entry : config.List("factors")) {
    campaign->factors.push_back(ReadFactor(entry, campaign->design));
    const std::string& key = campaign->factors.back().key;
    if (key == "seed" || key.starts_with("randomise")) {
      entry.Fault("key",
                  "'" + key + "' belongs to the campaign; write seed or randomise beside factors");
    }
    if (!keys.insert(key).second) {
      entry.Fault("key", {FaultKind::kRepeated, "'" + key + "' is a factor above; write one"});
    }
  }
  const double cells = CellsOf(*campaign);
  campaign->episodes = static_cast<int>(
      campaign->design == Design::kFull && campaign->factors.size() > 0 && cells <= kMostEpisodes
          ? config.Integer("episodes", Between(1, kMostEpisodes, ""),
                           static_cast<std::int64_t>(cells))
          : config.Integer("episodes", Between(1, kMostEpisodes, "")));
  if (campaign->design == Design::kFull && std::fmod(campaign->episodes, cells) != 0) {
    config.Fault("episodes", {FaultKind::kInconsistent,
                              fmt::format("{} episodes do not cover {} combinations of levels "
                                          "evenly; need a multiple of {}",
                                          campaign->episodes, cells, cells)});
  }
}

}  // namespace

Campaign ReadCampaign(const ConfigMap& config) {
  Campaign campaign;
  campaign.name = config.Text("name");
  RequirePlainName(config, "name", campaign.name);
  campaign.seed = static_cast<std::uint64_t>(config.Integer("seed", Between(0, kMostSeed, ""), 1));
  campaign.scenario = config.File("scenario");
  ReadDesign(config, &campaign);
  if (config.Has("randomise")) {
    campaign.randomise = config.Yaml("randomise");
    campaign.randomise_place = config.Place("randomise");
  }
  for (const ConfigMap& entry : config.List("accept")) campaign.rules.push_back(ReadRule(entry));
  campaign.redraws = static_cast<int>(config.Integer("redraws", Between(0, kMostRedraws, ""), 0));
  if (const auto splits = config.OptionalMap("splits")) campaign.splits = ReadSplits(*splits);
  campaign.outputs.shard_bytes = std::llround(kMostShardMb * kBytesPerMb);
  if (const auto outputs = config.OptionalMap("outputs")) campaign.outputs = ReadOutputs(*outputs);
  if (const auto outcome = config.OptionalMap("outcome")) campaign.outcome = ReadOutcome(*outcome);
  return campaign;
}

}  // namespace tera
