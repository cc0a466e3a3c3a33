#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/config/config.h"
#include "core/types/labels.h"
#include "dataset/export/export_options.h"

namespace tera {

/// A key of the scenario that the design varies: over levels (any YAML values), or over a range.
struct DesignFactor {
  std::string key;                  ///< "terrain.soil", as in --set
  std::vector<std::string> levels;  ///< YAML on one line; empty for a range
  double least = 0, most = 0;       ///< the range
  bool is_log = false;              ///< the range is covered evenly by its logarithm
  std::string place;                ///< in the campaign's file, for messages
};

enum class Design {
  kFull,            ///< each combination of levels, in turn
  kLatinHypercube,  ///< each factor's range in as many strata as episodes, each met once
  kSobol            ///< low-discrepancy sequence
};

/// A number of a finished episode.
struct SeenShare {  ///< share of frames with a box of this class
  SemanticClass label = SemanticClass::kPerson;
  std::string camera;  ///< channel; empty: frames of all cameras
  int visible_px = 1;  ///< least size of a box that counts
};
enum class ColumnFigure { kLargest, kLeast, kMean, kLast };
struct TableColumn {  ///< a figure of a column of a table
  std::string table, column;
  ColumnFigure figure = ColumnFigure::kLargest;
};
struct LargestTilt {  ///< largest angle between a machine's z axis and the vertical, degrees
  std::string machine;
};

/// Condition for accepting an episode: a number within bounds.
struct AcceptanceRule {
  std::string name;
  std::variant<SeenShare, TableColumn, LargestTilt> figure;
  double at_least = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();
  std::string place;  ///< in the campaign's file, for messages
};

/// Episodes of equal values of `by` stay together in one part.
struct Splits {
  std::vector<std::string> by;                         ///< keys of factors or of randomise:
  std::vector<std::pair<std::string, double>> shares;  ///< {train, 0.8}, ...
};

struct CampaignOutputs {
  std::vector<std::string> sensors;  ///< channels in the archives; empty: all cameras and lidars
  std::vector<std::string> exports;  ///< further formats of each episode, names of kExportFormats
  std::int64_t shard_bytes = 0;
  std::filesystem::path card;  ///< publisher's facts; empty: none
  bool keep_state = false;
};

/// The outcome of an episode for `tera sweep`: a figure of a report that a command of TERA makes of
/// it.
struct SweepOutcome {
  std::vector<std::string> run;  ///< words of the command; {episode}, {out} and {KEY} stand for
                                 ///< folders and the factor's value
  std::string report;            ///< the JSON file that it writes, below {out}
  std::string figure;            ///< path to a number in it (ReportFigure)
  std::string place, report_place, figure_place;  ///< in the campaign's file, for messages
};

/// Many episodes of one scenario.
///
/// Model   episode N is the scenario under the design's N-th point, with the draws of `randomise:`
///         for the seed hash(name, seed, N, draw). An episode that the rules refuse is drawn anew,
///         at most `redraws` times.
struct Campaign {
  std::string name;
  std::uint64_t seed = 1;
  std::filesystem::path folder;  ///< absolute; relative paths of values refer to it
  std::filesystem::path scenario;
  int episodes = 0;
  Design design = Design::kFull;
  std::vector<DesignFactor> factors;
  std::string randomise;  ///< YAML list that replaces the scenario's; empty: the scenario's own
  std::string randomise_place;
  std::vector<AcceptanceRule> rules;
  int redraws = 0;
  Splits splits;
  CampaignOutputs outputs;
  std::optional<SweepOutcome> outcome;
};

/// Reads a campaign. Faults go to `config`; call Config::Finish before use.
Campaign ReadCampaign(const ConfigMap& config);

}  // namespace tera
