#include "diagnose/next/next_manoeuvre.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "diagnose/blocks/suspect_list.h"
#include "diagnose/next/open_question.h"
#include "diagnose/next/piece_choice.h"
#include "diagnose/next/rehearsal.h"
#include "diagnose/search/fit/steady_gain.h"

namespace tera {
namespace {

constexpr double kMargin = 0.05;        ///< of the room, on either side
constexpr double kLeastTravel_s = 0.8;  ///< at full rate
constexpr double kFromStop_rad = 0.05;
constexpr double kReturnLever = 0.4;
constexpr double kReturnRest_s = 0.8;
constexpr double kFirstRest_s = 1;
constexpr double kClassWeight = 3;
constexpr double kWorthwhile = 0.5;  ///< power
constexpr std::uint64_t kDraws = 100;
constexpr double kRivalP = 0.05, kRivalGain = 3;
constexpr std::size_t kKindsTold = 4;
/// Manoeuvres that move, of TRAIN and SELECT and of FINAL: what a diagnosis needs, and what is
/// asked for.
constexpr std::size_t kSeenNeeded = 6, kFinalNeeded = 3, kSeenWanted = 12, kFinalWanted = 5;
constexpr std::size_t kMostSteps = 12;

bool HasManoeuvres(const std::vector<Manoeuvre>& manoeuvres, std::size_t seen, std::size_t final) {
  std::size_t has_seen = 0, has_final = 0;
  for (const Manoeuvre& manoeuvre : manoeuvres) {
    if (manoeuvre.axes != 0) ++(manoeuvre.part == Part::kFinal ? has_final : has_seen);
  }
  return has_seen >= seen && has_final >= final;
}

/// An axis with something open, and its room.
struct OpenAxis {
  AxisRoom room;
  DiagnosedAxis diagnosed;
  std::vector<OpenMatter> matters;
  int Rank() const {
    const bool has_class = std::any_of(matters.begin(), matters.end(),
                                       [](const OpenMatter& matter) { return matter.is_class; });
    return has_class ? 0 : diagnosed.diagnosis->is_testable ? 2 : 1;
  }
};

const RegimeVariable* PositionOf(const ReplayBlock& block) {
  for (const RegimeVariable& variable : block.channels.front().variables) {
    if (variable.name == "position/" + block.name) return &variable;
  }
  return nullptr;
}

/// As far as the recording went, and at least what full lever does in `kLeastTravel_s`, within the
/// joint's own limits.
AxisRoom RoomOf(const MachineModel& model, const ReplayBlock& block, std::size_t axis) {
  AxisRoom room{axis, block.name, 0, {}, {}};
  if (axis >= model.joints.size()) {
    room.full_rate_radps = model.gear_drives[axis - model.joints.size()].max_rate_radps;
    return room;
  }
  const Joint& joint = model.joints[axis];
  room.full_rate_radps = std::max(joint.max_rate_positive_radps, joint.max_rate_negative_radps);
  const RegimeVariable* position = PositionOf(block);
  double low = joint.initial_rad, high = joint.initial_rad;
  if (position != nullptr) {
    for (const double q : position->series.value) {
      low = std::min(low, q);
      high = std::max(high, q);
    }
  }
  const double lacking = kLeastTravel_s * room.full_rate_radps - (high - low);
  if (lacking > 0) {
    low -= lacking / 2;
    high += lacking / 2;
  }
  if (joint.type != JointType::kContinuous && joint.lower_rad < joint.upper_rad) {
    low = std::max(low, joint.lower_rad + kFromStop_rad);
    high = std::min(high, joint.upper_rad - kFromStop_rad);
  }
  const double margin = kMargin * (high - low);
  room.lower_rad = low + margin;
  room.upper_rad = high - margin;
  return room;
}

/// The machine as far as it is known: with what was found of joints, gears and their pumps.
MachineModel AsFound(MachineModel model, const std::vector<DiagnosedAxis>& blocks) {
  for (const DiagnosedAxis& one : blocks) {
    if (AxisNamed(model, one.block->name) < 0) continue;
    model = WithTerms(std::move(model), one.diagnosis->search.found.terms);
  }
  return model;
}

class Designer {
 public:
  Designer(const MachineModel& model, const std::vector<DiagnosedAxis>& blocks,
           const NextManoeuvreOptions& options, const Stream& stream)
      : nominal_(model), found_(AsFound(model, blocks)), options_(options), stream_(stream) {
    for (const Joint& joint : model.joints) at_rad_.push_back(joint.initial_rad);
    FindOpenAxes(blocks);
  }

  std::optional<NextManoeuvre> Design();

 private:
  void FindOpenAxes(const std::vector<DiagnosedAxis>& blocks);
  std::vector<LeverPiece> Chosen(const OpenAxis& axis) const;
  void Drive(const LeverPiece& piece, const OpenAxis& axis);
  void GoToMiddle(const AxisRoom& room);
  bool Stays(const Rehearsal& run) const;
  RehearsalSteps StepsOf(const OpenAxis& axis) const {
    return {options_.step_s, axis.diagnosed.block->period_s()};
  }
  double PowerOf(const OpenMatter& matter, const ReplayBlock& run, const OpenAxis& axis) const;
  double PowerOf(const OpenQuestion& question, bool is_class, ReplayBlock run,
                 const std::vector<Manoeuvre>& manoeuvres, const NoiseModel& noise) const;
  std::optional<ReplayBlock> RunSoFar(const OpenAxis& axis) const;
  void AddManoeuvres(const OpenAxis& axis);
  void Judge(const OpenAxis& axis, NextManoeuvre* out) const;

  const MachineModel& nominal_;
  const MachineModel found_;
  const NextManoeuvreOptions& options_;
  const Stream& stream_;
  std::vector<AxisRoom> rooms_;
  std::vector<OpenAxis> open_;
  std::vector<double> at_rad_;    ///< where the joints are by now
  std::vector<LeverMove> moves_;  ///< of the whole run so far
  double length_s_ = kFirstRest_s;
};

void Designer::FindOpenAxes(const std::vector<DiagnosedAxis>& blocks) {
  for (const DiagnosedAxis& one : blocks) {
    const int axis = AxisNamed(nominal_, one.block->name);
    if (axis < 0 || one.diagnosis->noise.empty()) continue;
    rooms_.push_back(RoomOf(nominal_, *one.block, static_cast<std::size_t>(axis)));
    auto matters = OpenMattersOf(*one.block, *one.diagnosis);
    if (!matters.empty()) open_.push_back({rooms_.back(), one, std::move(matters)});
  }
  std::stable_sort(open_.begin(), open_.end(),
                   [](const OpenAxis& a, const OpenAxis& b) { return a.Rank() < b.Rank(); });
}

/// The courses worth driving, from the middle of the room.
std::vector<LeverPiece> Designer::Chosen(const OpenAxis& axis) const {
  std::vector<AxisRoom> others;
  for (const AxisRoom& room : rooms_) {
    if (room.axis != axis.room.axis && room.lower_rad) others.push_back(room);
  }
  const std::vector<LeverPiece> pieces = LeverPiecesFor(axis.room, others);
  std::vector<double> middle_rad = at_rad_;
  for (const AxisRoom& room : rooms_) {
    if (room.axis < middle_rad.size()) {
      middle_rad[room.axis] = room.Middle_rad(middle_rad[room.axis]);
    }
  }
  std::vector<Rehearsal> runs;
  std::vector<double> begin_s, length_s;
  double at_s = 0;
  for (const LeverPiece& piece : pieces) {
    runs.push_back(Rehearse(found_, piece.moves, piece.length_s, middle_rad, StepsOf(axis)));
    begin_s.push_back(at_s);
    length_s.push_back(piece.length_s);
    at_s += piece.length_s;
  }
  if (runs.empty()) return {};
  const auto run = BlockOf(nominal_, Joined(runs), axis.room.axis, options_.step_s);
  if (!run) return {};
  std::vector<Segment> samples;
  const auto place_of = [&](double t_s) {
    const double place = (t_s - ToSeconds(run->first_ns)) / run->period_s();
    return static_cast<std::size_t>(
        std::clamp(place, 0.0, static_cast<double>(run->samples() - 1)));
  };
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    samples.push_back({place_of(begin_s[p]), place_of(begin_s[p] + length_s[p])});
  }
  std::vector<OpenQuestion> questions;
  std::vector<double> weight;
  for (const OpenMatter& matter : axis.matters) {
    for (const OpenQuestion& question : matter.questions) {
      questions.push_back(question);
      weight.push_back(matter.is_class ? kClassWeight : 1);
    }
  }
  const auto evidence =
      EvidenceOf(*run, axis.diagnosed.diagnosis->noise.front(), questions, samples);
  std::vector<LeverPiece> chosen;
  for (const std::size_t p : ChoosePieces(evidence, weight, length_s, options_.axis_s)) {
    chosen.push_back(pieces[p]);
  }
  return chosen;
}

bool Designer::Stays(const Rehearsal& run) const {
  return std::all_of(rooms_.begin(), rooms_.end(), [&](const AxisRoom& room) {
    if (!room.lower_rad || room.axis >= run.lowest_rad.size()) return true;
    // Where it is already is no reason not to move.
    const double low = std::min(*room.lower_rad, at_rad_[room.axis]);
    const double high = std::max(*room.upper_rad, at_rad_[room.axis]);
    return run.lowest_rad[room.axis] >= low && run.highest_rad[room.axis] <= high;
  });
}

/// By the lever, as far as the full rate says that it takes.
void Designer::GoToMiddle(const AxisRoom& room) {
  if (!room.lower_rad) return;
  const double away_rad = room.Middle_rad(0) - at_rad_[room.axis];
  const double hold_s = std::abs(away_rad) / (kReturnLever * room.full_rate_radps);
  if (hold_s < 0.05) return;
  const LeverPiece back{
      "",
      {{0, room.axis, std::copysign(kReturnLever, away_rad)}, {hold_s, room.axis, 0}},
      hold_s + kReturnRest_s};
  const Rehearsal run =
      Rehearse(found_, back.moves, back.length_s, at_rad_, {options_.step_s, options_.step_s});
  at_rad_ = run.end_rad;
  for (LeverMove move : back.moves) {
    move.t_s += length_s_;
    moves_.push_back(move);
  }
  length_s_ += back.length_s;
}

void Designer::Drive(const LeverPiece& piece, const OpenAxis& axis) {
  const auto rehearse = [&](const LeverPiece& one) {
    return Rehearse(found_, one.moves, one.length_s, at_rad_, {options_.step_s, options_.step_s});
  };
  LeverPiece driven = piece;
  Rehearsal run = rehearse(driven);
  if (!Stays(run)) {
    driven = Mirrored(piece, axis.room.axis);
    run = rehearse(driven);
  }
  if (!Stays(run)) {
    for (const AxisRoom& room : rooms_) {
      const bool is_moved =
          std::any_of(piece.moves.begin(), piece.moves.end(),
                      [&](const LeverMove& move) { return move.axis == room.axis; });
      if (is_moved) GoToMiddle(room);
    }
    driven = piece;
    run = rehearse(driven);
    if (!Stays(run)) return;
  }
  for (LeverMove move : driven.moves) {
    move.t_s += length_s_;
    moves_.push_back(move);
  }
  length_s_ += driven.length_s;
  at_rad_ = run.end_rad;
}

/// How often the tests that the diagnosis makes would tell the true account from the false one.
double Designer::PowerOf(const OpenQuestion& question, bool is_class, ReplayBlock run,
                         const std::vector<Manoeuvre>& manoeuvres, const NoiseModel& noise) const {
  const auto truth = run.predict(question.truth);
  for (std::size_t k = 0; k < run.samples(); ++k) {
    if (run.channels[0].measured.valid[k]) run.channels[0].measured.value[k] = truth[0][k];
  }
  const std::vector<Segment> whole = SeenSegmentsOf(manoeuvres);
  Mask mask(run.samples(), 0);
  for (const Segment& samples : whole) {
    for (std::size_t k = samples.begin; k < samples.end; ++k) mask[k] = 1;
  }
  const Likelihood likelihood(run, {noise}, mask);
  const StructureFitter fitter(run, likelihood, whole);
  const Misfit wrong = fitter.FitValues(question.instead).misfit;
  Misfit right = wrong;
  right.innovation[0].setZero();
  const auto pieces_of = [&](Part part) {
    return PiecesOf(SegmentsOf(manoeuvres, part), run.period_s());
  };
  const auto seen = GainsOf(likelihood, wrong, right, PiecesOf(whole, run.period_s()));
  const auto final = GainsOf(likelihood, wrong, right, pieces_of(Part::kFinal));
  const auto drawn = [&](std::vector<ManoeuvreGain> gains, std::uint64_t first) {
    // A draw's gain of log-likelihood is normal, of mean `possible` and twice its variance.
    for (ManoeuvreGain& gain : gains) {
      gain.gain = gain.possible + std::sqrt(2 * gain.possible) * stream_.Gaussian(first++);
    }
    return gains;
  };
  const double tests = static_cast<double>(std::max<std::size_t>(1, options_.suspects_in_all));
  std::uint64_t told = 0;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const std::uint64_t first = draw << 33;
    const auto gains = drawn(seen, first);
    double lead = 0;
    for (const ManoeuvreGain& gain : gains) lead += gain.gain;
    const double p = is_class ? SteadyGainP(gains) : GainP(gains);
    const bool is_told =
        is_class ? p <= kRivalP && lead >= kRivalGain
                 : p <= options_.alpha / tests &&
                       AreConfirming(drawn(final, first + (std::uint64_t{1} << 32)), kConfirmedP);
    told += is_told ? 1 : 0;
  }
  return static_cast<double>(told) / static_cast<double>(kDraws);
}

double Designer::PowerOf(const OpenMatter& matter, const ReplayBlock& run,
                         const OpenAxis& axis) const {
  const auto manoeuvres = ManoeuvresOf(run, stream_);
  if (!HasManoeuvres(manoeuvres, kSeenNeeded, kFinalNeeded)) return 0;
  double power = 1;
  for (const OpenQuestion& question : matter.questions) {
    power = std::min(power, PowerOf(question, matter.is_class, run, manoeuvres,
                                    axis.diagnosed.diagnosis->noise.front()));
  }
  return power;
}

/// From the initial position on, with the rest at its end.
std::optional<ReplayBlock> Designer::RunSoFar(const OpenAxis& axis) const {
  std::vector<double> start_rad;
  for (const Joint& joint : nominal_.joints) start_rad.push_back(joint.initial_rad);
  const Rehearsal whole =
      Rehearse(found_, moves_, length_s_ + options_.rest_s, start_rad, StepsOf(axis));
  return BlockOf(nominal_, whole, axis.room.axis, options_.step_s);
}

/// A recording of too few manoeuvres is not judged, however much they would tell: steps are added
/// until there are some more than enough, for they are shared out at random.
void Designer::AddManoeuvres(const OpenAxis& axis) {
  std::vector<LeverPiece> steps = LeverPiecesFor(axis.room, {});
  std::erase_if(steps, [](const LeverPiece& piece) { return !piece.what.starts_with("steps"); });
  for (std::size_t k = 0; !steps.empty() && k < kMostSteps; ++k) {
    const auto run = RunSoFar(axis);
    if (!run || HasManoeuvres(ManoeuvresOf(*run, stream_), kSeenWanted, kFinalWanted)) {
      return;
    }
    // The larger ones, in turn.
    Drive(steps[steps.size() - 1 - k % ((steps.size() + 1) / 2)], axis);
  }
}

void Designer::Judge(const OpenAxis& axis, NextManoeuvre* out) const {
  const auto run = RunSoFar(axis);
  for (const OpenMatter& matter : axis.matters) {
    const double power = run ? PowerOf(matter, *run, axis) : 0;
    (power >= kWorthwhile ? out->separates : out->leaves)
        .push_back({axis.room.name, matter.members, matter.is_class, power});
  }
}

/// "boom: steps of 0.15, steps of 1 and a slow ramp through neutral to 0.5 and back".
std::string DescriptionOf(const std::string& name, const std::vector<LeverPiece>& pieces) {
  std::map<std::string, std::size_t> times;
  std::vector<std::string> kinds;
  for (const LeverPiece& piece : pieces) {
    if (times[piece.what]++ == 0) kinds.push_back(piece.what);
  }
  std::stable_sort(kinds.begin(), kinds.end(),
                   [&](const std::string& a, const std::string& b) { return times[a] > times[b]; });
  const std::size_t told = std::min(kinds.size(), kKindsTold);
  std::string text = name + ": ";
  for (std::size_t k = 0; k < told; ++k) {
    const bool is_last = k + 1 == told;
    text += (k == 0 ? "" : is_last && told == kinds.size() ? " and " : ", ") + kinds[k];
  }
  return told < kinds.size() ? text + " and others" : text;
}

std::optional<NextManoeuvre> Designer::Design() {
  NextManoeuvre out;
  std::size_t driven = 0;
  std::vector<std::string> parts;
  for (const OpenAxis& axis : open_) {
    if (driven == options_.most_axes) {
      out.left_for_later.push_back(axis.room.name);
      continue;
    }
    const std::vector<LeverPiece> pieces = Chosen(axis);
    if (pieces.empty()) continue;
    const auto before = std::tuple(moves_, length_s_, at_rad_);
    GoToMiddle(axis.room);
    for (const LeverPiece& piece : pieces) Drive(piece, axis);
    AddManoeuvres(axis);
    const std::size_t told = out.separates.size();
    Judge(axis, &out);
    if (out.separates.size() == told) {  // not worth driving
      std::tie(moves_, length_s_, at_rad_) = before;
      continue;
    }
    ++driven;
    parts.push_back(DescriptionOf(axis.room.name, pieces));
  }
  if (out.separates.empty()) return std::nullopt;
  length_s_ += options_.rest_s;
  out.power = 1;
  for (const SeparatedMatter& one : out.separates) out.power = std::min(out.power, one.power);
  std::vector<double> start_rad;
  for (const Joint& joint : nominal_.joints) start_rad.push_back(joint.initial_rad);
  out.commands =
      Rehearse(found_, moves_, length_s_, start_rad, {options_.step_s, options_.step_s}).commands;
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
