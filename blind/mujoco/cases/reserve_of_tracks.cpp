#include <algorithm>

#include "blind/mujoco/cases/effect_parts.h"

namespace tera::blind::mujoco {
namespace {

/// Sideways the shoes slide all along, so that a track's thrust in a turn balances half the moment
/// of both. One track gives way four times as much as the other.
Effect ReservedEffectiveGauge(const Draw& draw) {
  constexpr double kSofter = 1.6, kHarder = 0.4;
  const double ratio = 1 + std::min(0.6, kTolerances.gauge * draw.Times());
  const double slip = 1 - 1 / ratio;
  const bool left_is_soft = draw.draws->Chance(0.5);
  const double contact_m = draw.numbers.contact_m, gauge_m = draw.numbers.gauge_m;
  Effect effect;
  effect.concealed.name = "effective_gauge";
  effect.concealed.form = "one track on hard ground, one on soft";
  effect.concealed.besides = {"icr_shift", "track_slip", "track_asymmetry"};
  effect.concealed.variables = {"turning", "speed"};
  effect.needs = {.joints = {}, .drives = true, .level = true};
  effect.put = [=](Forms* forms) {
    ShoeForm& shoes = forms->plant.shoes;
    shoes.gauge = 1;
    shoes.grip_across = 0.6;
    shoes.relaxation_m = RelaxationFor_m(slip, shoes.grip_across * contact_m / 4 / gauge_m);
    shoes.soft = {left_is_soft ? kSofter : kHarder, left_is_soft ? kHarder : kSofter};
  };
  return effect;
}

Effect ReservedTrackSlip(const Draw& draw) {
  const double slip = std::min(0.3, kTolerances.travel * draw.Times());
  Effect effect;
  effect.concealed.name = "track_slip";
  effect.concealed.form =
      "shoes that slide under the thrust of a blade, which digs ahead and trails back";
  effect.concealed.alike = {"track_scale", "rolling_resistance", "slope_slip"};
  effect.concealed.besides = {"effective_gauge"};
  effect.concealed.variables = {"speed", "turning"};
  effect.needs = {.joints = {}, .drives = true, .level = true};
  effect.put = [=](Forms* forms) {
    ShoeForm& shoes = forms->plant.shoes;
    shoes.drag_ahead = 0.2;
    shoes.drag_back = 0.1;
    shoes.grip_across = 0.1;
    shoes.relaxation_m = RelaxationFor_m(slip, shoes.drag_ahead / 2);
  };
  return effect;
}

Effect ReservedTrackAsymmetry(const Draw& draw) {
  const double apart = kTolerances.tracks_apart * draw.Times();
  const bool is_left = draw.draws->Chance(0.5);
  Effect effect;
  effect.concealed.name = "track_asymmetry";
  effect.concealed.form = "mud that packs on one sprocket under way";
  effect.concealed.variables = {"speed", "time"};
  effect.needs.drives = true;
  effect.put = [=](Forms* forms) { forms->plant.packs[is_left ? 0 : 1] = apart; };
  return effect;
}

}  // namespace

Effect DrawReservedOfTracks(const std::string& name, const Draw& draw) {
  return name == "effective_gauge" ? ReservedEffectiveGauge(draw)
         : name == "track_slip"    ? ReservedTrackSlip(draw)
                                   : ReservedTrackAsymmetry(draw);
}

}  // namespace tera::blind::mujoco
