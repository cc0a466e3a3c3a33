#include <algorithm>

#include "blind/mujoco/cases/effect_parts.h"
#include "core/check.h"

namespace tera::blind::mujoco {
namespace {

Effect EffectiveGauge(const Draw& draw) {
  const double ratio = 1 + std::min(0.7, kTolerances.gauge * draw.Times());
  const MachineNumbers& numbers = draw.numbers;
  Effect effect;
  effect.concealed.name = "effective_gauge";
  effect.concealed.form = draw.IsSecond() ? "shoes that bear at their outer edges"
                                          : "shoes that grip sideways and slide";
  effect.concealed.variables = {"turning", "speed"};
  effect.needs = {.joints = {}, .drives = true, .level = true};
  effect.put = [=, second = draw.IsSecond()](Forms* forms) {
    ShoeForm& shoes = forms->plant.shoes;
    if (second) {
      shoes.gauge = ratio;
      return;
    }
    shoes.gauge = 1;
    shoes.grip_across = 0.6;
    // Sliding sideways all along, a track's thrust balances half the moment of both.
    const double thrust = shoes.grip_across * numbers.contact_m / 4 / numbers.gauge_m;
    shoes.relaxation_m = RelaxationFor_m(1 - 1 / ratio, thrust);
  };
  return effect;
}

Effect TrackSlip(const Draw& draw) {
  const double slip = std::min(0.3, kTolerances.travel * draw.Times());
  Effect effect;
  effect.concealed.name = "track_slip";
  effect.concealed.form = draw.IsSecond()
                              ? "mud that lets every shoe slide by a share of its speed"
                              : "shoes that slide under the thrust that rolling resistance needs";
  effect.concealed.alike = {"track_scale", "rolling_resistance", "slope_slip"};
  effect.concealed.besides = {"effective_gauge"};
  effect.concealed.variables = {"speed", "turning"};
  effect.needs = {.joints = {}, .drives = true, .level = true};
  effect.put = [=, second = draw.IsSecond()](Forms* forms) {
    ShoeForm& shoes = forms->plant.shoes;
    if (second) {
      shoes.mud_slip = slip;
      return;
    }
    shoes.rolling = 0.2;
    shoes.grip_across = 0.1;
    shoes.relaxation_m = RelaxationFor_m(slip, shoes.rolling / 2);
  };
  return effect;
}

Effect TrackAsymmetry(const Draw& draw) {
  const double apart = kTolerances.tracks_apart * draw.Times() * draw.draws->Sign();
  Effect effect;
  effect.concealed.name = "track_asymmetry";
  effect.concealed.form =
      draw.IsSecond() ? "one sprocket worn" : "one sprocket larger than the other";
  effect.concealed.variables = {"speed"};
  effect.concealed.truth["difference"] = apart;
  effect.needs.drives = true;
  effect.put = [=, second = draw.IsSecond()](Forms* forms) {
    const double left = second ? -apart : -apart / 2, right = second ? 0 : apart / 2;
    forms->plant.sprocket = {1 + left, 1 + right};
  };
  return effect;
}

}  // namespace

const std::vector<std::string>& EffectsOfTracks() {
  static const std::vector<std::string> names = {"effective_gauge", "track_slip",
                                                 "track_asymmetry"};
  return names;
}

Effect DrawOfTracks(const std::string& name, const Draw& draw) {
  Effect effect = draw.IsReserved()           ? DrawReservedOfTracks(name, draw)
                  : name == "effective_gauge" ? EffectiveGauge(draw)
                  : name == "track_slip"      ? TrackSlip(draw)
                                              : TrackAsymmetry(draw);
  TERA_CHECK(effect.concealed.name == name, name);
  effect.concealed.target = "base";
  effect.concealed.channels = {"base"};
  return effect;
}

}  // namespace tera::blind::mujoco
