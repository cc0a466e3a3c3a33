#include "diagnose/blocks/candidate_list.h"

#include <algorithm>
#include <utility>

#include "core/check.h"
#include "physics/traction/track_drive.h"

namespace tera {
namespace {

/// Factors on the present main parameter, as starting values of the search for a wrong value.
constexpr double kChanges[] = {1.04, 0.96, 1.15, 0.87, 1.5, 0.67, 2.5, 0.4};

/// Widens bounds to include the present value. Bounds of a logarithmic parameter stay unchanged if
/// its present value is not positive, because it is unreachable.
FreeParameter Around(FreeParameter free, double present) {
  if (free.logarithmic && present <= 0) return free;
  free.lower = std::min(free.lower, present);
  free.upper = std::max(free.upper, present);
  return free;
}

/// Parameter values at which a mechanism has no effect.
std::vector<double> WithoutEffect(const Mechanism& mechanism) {
  std::vector<double> values;
  for (const EffectParameter& parameter : mechanism.parameters) {
    values.push_back(parameter.otherwise.value_or(0));
  }
  return values;
}

std::vector<std::vector<double>> StartsFrom(const std::vector<double>& present,
                                            const FreeParameter& main) {
  std::vector<std::vector<double>> starts;
  for (const double change : kChanges) {
    std::vector<double> start = present;
    start[main.index] = std::clamp(change * present[main.index], main.lower, main.upper);
    if (start != present) starts.push_back(std::move(start));
  }
  return starts;
}

Effects* EffectsOf(const std::string& target, MachineModel* model) {
  if (target == "base") return &model->effects.base;
  if (const int joint = model->JointIndex(target); joint >= 0) {
    return &model->effects.joints[static_cast<std::size_t>(joint)];
  }
  for (std::size_t g = 0; g < model->ground_tools.gears.size(); ++g) {
    if (model->ground_tools.gears[g].name == target) return &model->effects.gears[g];
  }
  for (std::size_t p = 0; p < model->pumps.size(); ++p) {
    if (model->pumps[p].name == target) return &model->effects.pumps[p];
  }
  return nullptr;
}

}  // namespace

Candidate& CandidateList::Add(std::string_view id, std::vector<FreeParameter> free,
                              std::vector<std::vector<double>> starts) {
  const auto mechanism = std::find_if(library_.begin(), library_.end(), [&](const Mechanism& m) {
    return m.id == id && m.ActsOn(kind_);
  });
  TERA_CHECK(mechanism != library_.end(), id);
  for (const auto& start : starts) TERA_CHECK(start.size() == mechanism->parameters.size(), id);
  Candidate candidate{&*mechanism, target_, std::move(free), std::move(starts), {}};
  if (const Effect* effect = FindEffect(present_, id)) {
    candidate.present = effect->values;
    for (FreeParameter& one : candidate.free) one = Around(one, candidate.present[one.index]);
    if (candidate.free.empty()) {
      candidate.starts.push_back(WithoutEffect(*mechanism));
    } else {
      auto near = StartsFrom(candidate.present, candidate.free.front());
      candidate.starts.insert(candidate.starts.begin(), near.begin(), near.end());
    }
  }
  return found_.emplace_back(std::move(candidate));
}

Effects WithTerms(Effects present, const Structure& terms) {
  for (const Term& term : terms) {
    const Effect effect{term.candidate->mechanism, term.values};
    const auto same = std::find_if(present.begin(), present.end(), [&](const Effect& one) {
      return one.mechanism->id == effect.mechanism->id;
    });
    if (same == present.end()) {
      present.push_back(effect);
    } else {
      *same = effect;
    }
  }
  return present;
}

MachineModel WithTerms(MachineModel model, const Structure& terms) {
  model.effects.joints.resize(model.joints.size());
  model.effects.gears.resize(model.ground_tools.gears.size());
  model.effects.pumps.resize(model.pumps.size());
  for (const Term& term : terms) {
    Effects* effects = EffectsOf(term.candidate->target, &model);
    if (effects != nullptr) *effects = WithTerms(*effects, {term});
  }
  SetShoeRatios(&model);
  return model;
}

}  // namespace tera
