#include "diagnose/perception/registration/sensor_candidates.h"

#include <algorithm>

#include "core/check.h"
#include "diagnose/blocks/candidate_list.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

/// Where a clock is looked for.
constexpr double kClockOffsets_s[] = {0.1, -0.1, 0.3, -0.3, 1, -1, 3, -3, 18, -18};

/// How far a sensor that was installed with care may be off: standard deviation of a parameter,
/// which its unit tells.
double PriorSigmaOf(std::string_view unit) {
  if (unit == "m") return 0.3;
  if (unit == "deg") return 5;
  if (unit == "s") return 1;
  TERA_CHECK(unit == "1", unit);
  return 0.05;
}

class Candidates {
 public:
  Candidates(const std::string& sensor, EffectTarget kind, const Effects& present)
      : kind_(kind), list_(sensor, kind, present, SensorMechanisms()) {}

  /// Adds a mechanism, if the kind has it, with all parameters free in the ranges of the table.
  void Add(std::string_view id, const std::vector<std::vector<double>>& starts) {
    const auto mechanism =
        std::find_if(SensorMechanisms().begin(), SensorMechanisms().end(),
                     [&](const Mechanism& one) { return one.id == id && one.ActsOn(kind_); });
    if (mechanism == SensorMechanisms().end()) return;
    std::vector<FreeParameter> free;
    for (std::size_t i = 0; i < mechanism->parameters.size(); ++i) {
      const EffectParameter& parameter = mechanism->parameters[i];
      free.push_back({.index = i,
                      .lower = parameter.lower,
                      .upper = parameter.upper,
                      .prior_sigma = PriorSigmaOf(parameter.unit)});
    }
    list_.Add(id, std::move(free), starts);
  }

  std::vector<Candidate> Take() { return list_.Take(); }

 private:
  EffectTarget kind_;
  CandidateList list_;
};

}  // namespace

std::vector<Candidate> CandidatesOf(EffectTarget kind, ComparedBy compared,
                                    const std::string& sensor, const Effects& present) {
  Candidates candidates(sensor, kind, present);
  candidates.Add("extrinsic", {{0, 0, 0, 0, 0, 0}});
  if (compared == ComparedBy::kRanges) {
    candidates.Add("range_bias", {{0}});
    candidates.Add("scale", {{1}});
  }
  std::vector<std::vector<double>> offsets = {{0}};
  for (const double offset_s : kClockOffsets_s) offsets.push_back({offset_s});
  candidates.Add("clock_offset", offsets);
  return candidates.Take();
}

}  // namespace tera
