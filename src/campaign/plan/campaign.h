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

/// A scenario key that the design varies, over levels (any YAML values) or over a range of numbers.
struct DesignFactor {
  std::string key;                  ///< such as "terrain.soil", as in --set
  std::vector<std::string> levels;  ///< each as one line of YAML; empty for a range
  double least = 0, most = 0;       ///< bounds of the range
  bool is_log = false;              ///< the range is covered uniformly in the logarithm
  std::string place;                ///< place in the campaign file, for messages
};

enum class Design {
  kFull,            ///< every combination of levels, in order
  kLatinHypercube,  ///< a factor's range has as many strata as there are episodes; each stratum is
                    ///< used once
  kSobol            ///< low-discrepancy sequence
};

/// Quantities of a finished episode that a rule can test.
struct SeenShare {  ///< fraction of frames that have a box of this class
  SemanticClass label = SemanticClass::kPerson;
  std::string camera;  ///< channel; empty: frames of all cameras
  int visible_px = 1;  ///< least number of visible pixels of a box that counts
};
enum class ColumnFigure { kLargest, kLeast, kMean, kLast };
struct TableColumn {  ///< a statistic of one column of a table
  std::string table, column;
  ColumnFigure figure = ColumnFigure::kLargest;
};
struct LargestTilt {  ///< largest angle between the z axis of a machine and the vertical, in
                      ///< degrees
  std::string machine;
};

/// Condition for accepting an episode: a quantity must lie within bounds.
struct AcceptanceRule {
  std::string name;
  std::variant<SeenShare, TableColumn, LargestTilt> figure;
  double at_least = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();
  std::string place;  ///< place in the campaign file, for messages
};

/// Assignment of episodes to splits such as train and test. Episodes with equal values of `by` are
/// in the same split.
struct Splits {
  std::vector<std::string> by;                         ///< keys of factors or of `randomise`
  std::vector<std::pair<std::string, double>> shares;  ///< {train, 0.8}, ...
};

struct CampaignOutputs {
  std::vector<std::string> sensors;  ///< channels in the archives; empty: all cameras and lidars
  std::vector<std::string> exports;  ///< additional formats in which each episode is exported, by
                                     ///< their names in kExportFormats
  std::int64_t shard_bytes = 0;
  std::filesystem::path card;  ///< file with the publisher's facts; empty: none
  bool keep_state = false;
};

/// Outcome of an episode for `tera sweep`: a number in a report that a tera command creates from
/// the episode.
struct SweepOutcome {
  std::vector<std::string> run;  ///< words of the command; {episode} and {out} are replaced by
                                 ///< folders, {KEY} by the value of the factor
  std::string report;            ///< JSON file that the command writes below {out}
  std::string figure;            ///< path of the number in the report (ReportFigure)
  std::string place, report_place, figure_place;  ///< places in the campaign file, for messages
};

/// Many episodes of one scenario.
///
/// Model   Episode N is the scenario with the values of design point N. The draws of `randomise`
///         have the seed hash(name, seed, N, draw). An episode that violates a rule is drawn again,
///         at most `redraws` times.
struct Campaign {
  std::string name;
  std::uint64_t seed = 1;
  std::filesystem::path folder;  ///< absolute path; base of relative paths in values
  std::filesystem::path scenario;
  int episodes = 0;
  Design design = Design::kFull;
  std::vector<DesignFactor> factors;
  std::string randomise;  ///< YAML list that replaces the scenario's `randomise`; empty: the
                          ///< scenario's own
  std::string randomise_place;
  std::vector<AcceptanceRule> rules;
  int redraws = 0;
  Splits splits;
  CampaignOutputs outputs;
  std::optional<SweepOutcome> outcome;
};

/// Reads a campaign. Faults are reported at `config`; call Config::Finish before using the result.
Campaign ReadCampaign(const ConfigMap& config);

}  // namespace tera
