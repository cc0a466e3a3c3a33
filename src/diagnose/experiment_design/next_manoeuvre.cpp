#include "diagnose/experiment_design/next_manoeuvre.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "diagnose/blocks/candidate_list.h"
#include "diagnose/experiment_design/greedy_design.h"
#include "diagnose/experiment_design/predicted_run.h"
#include "physics/actuation/axes.h"

namespace tera {
namespace {

constexpr double kAxis_s = 34;          ///< time for the excitations of one axis
constexpr std::size_t kMostAxes = 3;    ///< largest number of axes in one run
constexpr double kMargin = 0.05;        ///< free margin at either end, over the range
constexpr double kLeastTravel_s = 0.8;  ///< least travel of the range, in time at full rate
constexpr double kFromStop_rad = 0.05;  ///< distance to a joint's own limits
constexpr double kReturnLever = 0.4;    ///< for returns to the middle of a range
constexpr double kReturnRest_s = 0.8;
constexpr double kShortestReturn_s = 0.05;           ///< a shorter way back is not driven
constexpr double kFirstRest_s = 1, kLastRest_s = 4;  ///< the last shows slow noise
constexpr double kClassWeight = 3;  ///< of a pair of a class, over one of a mechanism not seen
/// Least power at which an ambiguity set counts as discriminated.
constexpr double kLeastPower = 0.5;
constexpr std::size_t kMostKindsListed = 4;  ///< kinds of excitations named in a description
/// Number of commanded manoeuvres, in TRAIN with SELECT and in FINAL, at which no more steps are
/// added: about twice the number that a diagnosis needs.
constexpr std::size_t kAmpleSeen = 12, kAmpleFinal = 5;
constexpr std::size_t kMostSteps = 12;  ///< added to one axis

/// True if there are more commanded manoeuvres than a diagnosis needs. The surplus allows for their
/// random assignment to parts.
bool HasAmpleManoeuvres(const std::vector<Manoeuvre>& manoeuvres) {
  std::size_t seen = 0, final = 0;
  for (const Manoeuvre& manoeuvre : manoeuvres) {
    if (manoeuvre.axes != 0) ++(manoeuvre.part == Part::kFinal ? final : seen);
  }
  return seen >= kAmpleSeen && final >= kAmpleFinal;
}

/// An axis with open hypotheses, and its range.
struct AmbiguousAxis {
  AxisRange range;
  DiagnosedAxis diagnosed;
  std::vector<AmbiguitySet> ambiguity_sets;
  /// Order of axes: first ambiguous findings, then blocks that could not be judged, then
  /// undetectable mechanisms.
  int Rank() const {
    const bool has_class = std::any_of(ambiguity_sets.begin(), ambiguity_sets.end(),
                                       [](const AmbiguitySet& set) { return set.is_class; });
    return has_class ? 0 : diagnosed.diagnosis->is_testable ? 2 : 1;
  }
};

const RegimeVariable* PositionOf(const ReplayBlock& block) {
  for (const RegimeVariable& variable : block.channels.front().variables) {
    if (variable.name == "position/" + block.name) return &variable;
  }
  return nullptr;
}

/// Recorded range of an axis, widened to the travel of kLeastTravel_s at full rate, within the
/// joint's own limits.
AxisRange AxisRangeOf(const MachineModel& model, const ReplayBlock& block, std::size_t axis) {
  AxisRange range{axis, block.name, 0, {}, {}};
  if (axis >= model.joints.size()) {
    range.full_rate_radps = model.gear_drives[axis - model.joints.size()].max_rate_radps;
    return range;
  }
  const Joint& joint = model.joints[axis];
  range.full_rate_radps = std::max(joint.max_rate_positive_radps, joint.max_rate_negative_radps);
  const RegimeVariable* position = PositionOf(block);
  double low = joint.initial_rad, high = joint.initial_rad;
  if (position != nullptr) {
    for (const double q : position->series.value) {
      low = std::min(low, q);
      high = std::max(high, q);
    }
  }
  const double lacking = kLeastTravel_s * range.full_rate_radps - (high - low);
  if (lacking > 0) {
    low -= lacking / 2;
    high += lacking / 2;
  }
  if (joint.type != JointType::kContinuous && joint.lower_rad < joint.upper_rad) {
    low = std::max(low, joint.lower_rad + kFromStop_rad);
    high = std::min(high, joint.upper_rad - kFromStop_rad);
  }
  const double margin = kMargin * (high - low);
  range.lower_rad = low + margin;
  range.upper_rad = high - margin;
  return range;
}

/// The machine with the found effects of joints, running gears and their pumps.
MachineModel AsFound(MachineModel model, const std::vector<DiagnosedAxis>& blocks) {
  for (const DiagnosedAxis& one : blocks) {
    if (AxisNamed(model, one.block->name) < 0) continue;
    model = WithTerms(std::move(model), one.diagnosis->search.found.terms);
  }
  return model;
}

/// Designs one run: it chooses excitations for each axis and appends them one after another.
class Designer {
 public:
  Designer(const MachineModel& model, const std::vector<DiagnosedAxis>& blocks,
           const NextManoeuvreOptions& options, const Stream& stream)
      : nominal_(model), found_(AsFound(model, blocks)), options_(options), stream_(stream) {
    for (const Joint& joint : model.joints) at_rad_.push_back(joint.initial_rad);
    FindAmbiguousAxes(blocks);
  }

  std::optional<NextManoeuvre> Design();

 private:
  void FindAmbiguousAxes(const std::vector<DiagnosedAxis>& blocks);
  std::vector<Excitation> Chosen(const AmbiguousAxis& axis) const;
  void Drive(const Excitation& excitation, const AmbiguousAxis& axis);
  void GoToMiddle(const AxisRange& range);
  bool Stays(const PredictedRun& run) const;
  std::optional<ReplayBlock> RunSoFar(const AmbiguousAxis& axis) const;
  void AddManoeuvres(const AmbiguousAxis& axis);
  void Judge(const AmbiguousAxis& axis, NextManoeuvre* out) const;

  const MachineModel& nominal_;
  const MachineModel found_;
  const NextManoeuvreOptions& options_;
  const Stream& stream_;
  std::vector<AxisRange> ranges_;
  std::vector<AmbiguousAxis> open_;
  std::vector<double> at_rad_;    ///< predicted positions at the end of the run so far
  std::vector<LeverMove> moves_;  ///< lever moves of the run so far
  double length_s_ = kFirstRest_s;
};

void Designer::FindAmbiguousAxes(const std::vector<DiagnosedAxis>& blocks) {
  for (const DiagnosedAxis& one : blocks) {
    const int axis = AxisNamed(nominal_, one.block->name);
    if (axis < 0 || one.diagnosis->noise.empty()) continue;
    ranges_.push_back(AxisRangeOf(nominal_, *one.block, static_cast<std::size_t>(axis)));
    auto ambiguity_sets = AmbiguitySetsOf(*one.block, *one.diagnosis);
    if (!ambiguity_sets.empty()) open_.push_back({ranges_.back(), one, std::move(ambiguity_sets)});
  }
  std::stable_sort(open_.begin(), open_.end(), [](const AmbiguousAxis& a, const AmbiguousAxis& b) {
    return a.Rank() < b.Rank();
  });
}

/// Chooses excitations of an axis, predicted from the middle of all ranges.
std::vector<Excitation> Designer::Chosen(const AmbiguousAxis& axis) const {
  std::vector<AxisRange> others;
  for (const AxisRange& range : ranges_) {
    if (range.axis != axis.range.axis && range.lower_rad) others.push_back(range);
  }
  const std::vector<Excitation> excitations = ExcitationsFor(axis.range, others);
  std::vector<double> middle_rad = at_rad_;
  for (const AxisRange& range : ranges_) {
    if (range.axis < middle_rad.size()) {
      middle_rad[range.axis] = range.Middle_rad(middle_rad[range.axis]);
    }
  }
  std::vector<PredictedRun> runs;
  std::vector<double> begin_s, length_s;
  double at_s = 0;
  for (const Excitation& excitation : excitations) {
    runs.push_back(PredictRun(found_, excitation.moves, excitation.length_s, middle_rad,
                              axis.diagnosed.block->period_s()));
    begin_s.push_back(at_s);
    length_s.push_back(excitation.length_s);
    at_s += excitation.length_s;
  }
  if (runs.empty()) return {};
  const auto run = BlockOf(nominal_, Concatenated(runs), axis.range.axis);
  if (!run) return {};
  std::vector<Segment> samples;
  const auto place_of = [&](double t_s) {
    const double place = (t_s - ToSeconds(run->first_ns)) / run->period_s();
    return static_cast<std::size_t>(
        std::clamp(place, 0.0, static_cast<double>(run->samples() - 1)));
  };
  for (std::size_t p = 0; p < excitations.size(); ++p) {
    samples.push_back({place_of(begin_s[p]), place_of(begin_s[p] + length_s[p])});
  }
  std::vector<RivalPair> pairs;
  std::vector<double> weight;
  for (const AmbiguitySet& set : axis.ambiguity_sets) {
    for (const RivalPair& pair : set.pairs) {
      pairs.push_back(pair);
      weight.push_back(set.is_class ? kClassWeight : 1);
    }
  }
  const auto information =
      InformationOf(*run, axis.diagnosed.diagnosis->noise.front(), pairs, samples);
  std::vector<Excitation> chosen;
  for (const std::size_t p : ChooseExcitations(information, weight, length_s, kAxis_s)) {
    chosen.push_back(excitations[p]);
  }
  return chosen;
}

/// True if a run stays within all ranges.
bool Designer::Stays(const PredictedRun& run) const {
  return std::all_of(ranges_.begin(), ranges_.end(), [&](const AxisRange& range) {
    if (!range.lower_rad || range.axis >= run.lowest_rad.size()) return true;
    // An axis already outside its range may move, but not further out.
    const double low = std::min(*range.lower_rad, at_rad_[range.axis]);
    const double high = std::max(*range.upper_rad, at_rad_[range.axis]);
    return run.lowest_rad[range.axis] >= low && run.highest_rad[range.axis] <= high;
  });
}

/// Moves an axis to the middle of its range. The duration assumes its full rate.
void Designer::GoToMiddle(const AxisRange& range) {
  if (!range.lower_rad) return;
  const double away_rad = range.Middle_rad(0) - at_rad_[range.axis];
  const double hold_s = std::abs(away_rad) / (kReturnLever * range.full_rate_radps);
  if (hold_s < kShortestReturn_s) return;
  const Excitation back{
      "",
      {{0, range.axis, std::copysign(kReturnLever, away_rad)}, {hold_s, range.axis, 0}},
      hold_s + kReturnRest_s};
  const PredictedRun run = PredictRun(found_, back.moves, back.length_s, at_rad_);
  at_rad_ = run.end_rad;
  for (LeverMove move : back.moves) {
    move.t_s += length_s_;
    moves_.push_back(move);
  }
  length_s_ += back.length_s;
}

/// Tries an excitation as it is, then mirrored, then after moves to the middle of the ranges.
/// Appends the first that stays within the ranges. If none does, it appends only the moves to the
/// middle.
void Designer::Drive(const Excitation& excitation, const AmbiguousAxis& axis) {
  const auto predicted = [&](const Excitation& one) {
    return PredictRun(found_, one.moves, one.length_s, at_rad_);
  };
  Excitation driven = excitation;
  PredictedRun run = predicted(driven);
  if (!Stays(run)) {
    driven = Mirrored(excitation, axis.range.axis);
    run = predicted(driven);
  }
  if (!Stays(run)) {
    for (const AxisRange& range : ranges_) {
      const bool is_moved =
          std::any_of(excitation.moves.begin(), excitation.moves.end(),
                      [&](const LeverMove& move) { return move.axis == range.axis; });
      if (is_moved) GoToMiddle(range);
    }
    driven = excitation;
    run = predicted(driven);
    if (!Stays(run)) return;
  }
  for (LeverMove move : driven.moves) {
    move.t_s += length_s_;
    moves_.push_back(move);
  }
  length_s_ += driven.length_s;
  at_rad_ = run.end_rad;
}

/// Block of an axis over the run so far, with the rest at its end.
std::optional<ReplayBlock> Designer::RunSoFar(const AmbiguousAxis& axis) const {
  std::vector<double> start_rad;
  for (const Joint& joint : nominal_.joints) start_rad.push_back(joint.initial_rad);
  const PredictedRun whole = PredictRun(found_, moves_, length_s_ + kLastRest_s, start_rad,
                                        axis.diagnosed.block->period_s());
  return BlockOf(nominal_, whole, axis.range.axis);
}

/// Adds steps until a diagnosis has ample manoeuvres. A recording with too few is not judged,
/// however informative they are.
void Designer::AddManoeuvres(const AmbiguousAxis& axis) {
  std::vector<Excitation> steps = ExcitationsFor(axis.range, {});
  std::erase_if(steps,
                [](const Excitation& excitation) { return !excitation.what.starts_with("steps"); });
  for (std::size_t k = 0; !steps.empty() && k < kMostSteps; ++k) {
    const auto run = RunSoFar(axis);
    if (!run || HasAmpleManoeuvres(ManoeuvresOf(*run, stream_))) {
      return;
    }
    // Only the larger half of the steps, in turn.
    Drive(steps[steps.size() - 1 - k % ((steps.size() + 1) / 2)], axis);
  }
}

/// Sorts the ambiguity sets of an axis into discriminated and other ones.
void Designer::Judge(const AmbiguousAxis& axis, NextManoeuvre* out) const {
  const auto run = RunSoFar(axis);
  const NoiseModel& noise = axis.diagnosed.diagnosis->noise.front();
  const auto tests = static_cast<double>(std::max<std::size_t>(1, options_.total_candidates));
  const double tests_level = options_.alpha / tests;
  for (const AmbiguitySet& set : axis.ambiguity_sets) {
    const double power = run ? DiscriminationPower(set, *run, noise, tests_level, stream_) : 0;
    (power >= kLeastPower ? out->discriminated : out->not_discriminated)
        .push_back({axis.range.name, set.members, set.is_class, power});
  }
}

/// "boom: steps of 0.15, steps of 1 and a slow ramp through neutral to 0.5 and back".
std::string DescriptionOf(const std::string& name, const std::vector<Excitation>& excitations) {
  std::map<std::string, std::size_t> times;
  std::vector<std::string> kinds;
  for (const Excitation& excitation : excitations) {
    if (times[excitation.what]++ == 0) kinds.push_back(excitation.what);
  }
  std::stable_sort(kinds.begin(), kinds.end(),
                   [&](const std::string& a, const std::string& b) { return times[a] > times[b]; });
  const std::size_t listed = std::min(kinds.size(), kMostKindsListed);
  std::string text = name + ": ";
  for (std::size_t k = 0; k < listed; ++k) {
    const bool is_last = k + 1 == listed;
    text += (k == 0 ? "" : is_last && listed == kinds.size() ? " and " : ", ") + kinds[k];
  }
  return listed < kinds.size() ? text + " and others" : text;
}

std::optional<NextManoeuvre> Designer::Design() {
  NextManoeuvre out;
  std::size_t driven = 0;
  std::vector<std::string> parts;
  for (const AmbiguousAxis& axis : open_) {
    if (driven == kMostAxes) {
      out.deferred.push_back(axis.range.name);
      continue;
    }
    const std::vector<Excitation> excitations = Chosen(axis);
    if (excitations.empty()) continue;
    const auto before = std::tuple(moves_, length_s_, at_rad_);
    GoToMiddle(axis.range);
    for (const Excitation& excitation : excitations) Drive(excitation, axis);
    AddManoeuvres(axis);
    const std::size_t discriminated = out.discriminated.size();
    Judge(axis, &out);
    if (out.discriminated.size() == discriminated) {  // not worth driving
      std::tie(moves_, length_s_, at_rad_) = before;
      continue;
    }
    ++driven;
    parts.push_back(DescriptionOf(axis.range.name, excitations));
  }
  if (out.discriminated.empty()) return std::nullopt;
  length_s_ += kLastRest_s;
  out.power = 1;
  for (const DiscriminatedSet& one : out.discriminated) out.power = std::min(out.power, one.power);
  std::vector<double> start_rad;
  for (const Joint& joint : nominal_.joints) start_rad.push_back(joint.initial_rad);
  out.commands = PredictRun(found_, moves_, length_s_, start_rad).commands;
  out.duration_s = length_s_;
  out.description = fmt::format("{}", fmt::join(parts, "; "));
  return out;
}

}  // namespace

std::optional<NextManoeuvre> DesignNextManoeuvre(const MachineModel& model,
                                                 const std::vector<DiagnosedAxis>& blocks,
                                                 const NextManoeuvreOptions& options,
                                                 const Stream& stream) {
  return Designer(model, blocks, options, stream).Design();
}

}  // namespace tera
