#include "blind/plant/concealed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "blind/plant/axis_equations.h"
#include "core/check.h"

namespace tera::blind {
namespace {

/// Inputs for making a form.
struct Setting {
  Strength strength;
  std::size_t axis;
  const Excavator& excavator;
  const AxisValues& start_rad;
  const Stream& stream;

  /// One of three by strength, up to 15 % more or less.
  double Size(double strong, double medium, double faint) const {
    const double size = strength == Strength::kStrong   ? strong
                        : strength == Strength::kMedium ? medium
                                                        : faint;
    return size * std::exp(0.3 * (stream.Uniform(0) - 0.5));
  }
};

/// The exponent of a power law nearest to an area over the lever's stroke.
double NearestExponent(double area_square) {
  double best = 1, least = 1e9;
  for (double n = 1; n < 2.5; n += 0.001) {
    double sum = 0;
    for (double u = 0.02; u <= 1; u += 0.02) {
      const double area = (1 - area_square) * u + area_square * u * u;
      sum += std::pow(std::pow(u, n) - area, 2);
    }
    if (sum < least) least = sum, best = n;
  }
  return best;
}

void DeadBand(const Setting& s, Hidden* out) {
  out->form.notch = 0.01 + 0.03 * s.stream.Uniform(1);
  const double width = s.Size(0.16, 0.08, 0.035);
  out->form.overlap = std::max(0.005, width - out->form.notch / 2);
  out->concealed.form = "spool that overlaps its port, round notch";
  out->concealed.truth["width"] = out->form.overlap + out->form.notch / 2;
}

void Delay(const Setting& s, Hidden* out) {
  const double delay_s = s.Size(0.25, 0.12, 0.05);
  if (s.stream.Uniform(1) < 0.5) {
    out->form.line_stages = 24;
    out->form.line_s = delay_s;
    out->concealed.form = "line of 24 equal lags";
  } else {
    out->form.queue_jitter_s = 0.015;
    out->form.queue_s = delay_s - 0.012;
    out->concealed.form = "queue that delivers in order with jitter of 15 ms";
  }
  out->concealed.truth["delay_s"] = delay_s;
  out->concealed.variables = {};
}

/// The longer of two lags whose answer to an impulse has the mean and the variance of that of all
/// three.
double LongerOfTwo_s(double lag_s) {
  double variance = 0;
  for (const double share : kLagShares) variance += share * share;
  return lag_s * (1 + std::sqrt(2 * variance - 1)) / 2;
}

void Lag(const Setting& s, Hidden* out) {
  out->form.lag_s = s.Size(0.3, 0.13, 0.05);
  out->concealed.form = "three lags in a row, 50 : 10 : 3";
  out->concealed.truth["time_s"] = LongerOfTwo_s(out->form.lag_s);
  out->concealed.variables = {};
}

void RateLimit(const Setting& s, Hidden* out) {
  out->form.slew_per_s = s.Size(1.5, 4, 10);
  const PlainAxis& axis = s.excavator.axis(s.axis);
  const double full = std::max(axis.rate_positive_radps, axis.rate_negative_radps);
  out->concealed.form = "spool driven by a pilot that saturates smoothly";
  out->concealed.truth["max_change_radps2"] = out->form.slew_per_s * full;
  out->concealed.variables = {};
}

void Saturation(const Setting& s, Hidden* out) {
  out->form.area_end = std::min(0.95, s.Size(0.55, 0.75, 0.9));
  out->concealed.form = "notch area that ends, rounded";
  out->concealed.truth["limit"] = out->form.area_end;
}

void ValveCurve(const Setting& s, Hidden* out) {
  out->form.area_square = std::min(0.95, s.Size(0.85, 0.5, 0.2));
  out->concealed.form = "triangular notch in a slot: area linear and square";
  out->concealed.truth["exponent"] = NearestExponent(out->form.area_square);
}

void AsymmetricGain(const Setting& s, Hidden* out) {
  // Bore and rod of a cylinder without regeneration.
  const double rod_share = s.Size(0.42, 0.25, 0.11);
  out->form.piston_ratio = 1 / (1 - rod_share);
  out->concealed.form = "one flow over two areas of a piston";
  out->concealed.truth["ratio"] = out->form.piston_ratio;
}

void Gain(const Setting& s, Hidden* out) {
  out->form.delivered = 1 - s.Size(0.28, 0.16, 0.08);
  out->concealed.form = "worn pump that delivers less";
  out->concealed.truth["gain"] = out->form.delivered;
}

void Hold(const Setting& s, Hidden* out) {
  out->form.hold_s = std::round(s.Size(0.3, 0.16, 0.08) / 0.02) * 0.02;
  out->concealed.form = "reader that looks at the bus once a period";
  out->concealed.truth["period_s"] = out->form.hold_s;
  out->concealed.variables = {};
}

void Droop(const Setting& s, Hidden* out) {
  const double load_nm = std::abs(s.excavator.Loads_nm(s.start_rad)[s.axis]);
  out->form.supply_nm = load_nm / s.Size(0.45, 0.22, 0.09);
  out->concealed.form = "orifice into compressible oil that moves the mass";
  out->concealed.besides = {"actuator_ring", "structural_flex"};  // the oil is a spring
  out->concealed.truth["stall_nm"] = out->form.supply_nm;
  const std::string joint = kJoints[s.axis];
  out->concealed.variables = {"load/" + joint, "position/" + joint, "lever/" + joint};
}

void Pins(const Setting& s, Hidden* out) {
  out->form.pins = true;
  out->form.pins_at_rad = s.start_rad[s.axis];
  out->concealed.form = "distance of the cylinder's pins, differentiated";
  out->concealed.truth["reference_rad"] = out->form.pins_at_rad;
  const std::string joint = kJoints[s.axis];
  out->concealed.variables = {"position/" + joint, "load/" + joint, "lever/" + joint};
}

void Flex(const Setting& s, Hidden* out) {
  out->form.flex_radps = s.Size(8, 14, 28);
  out->form.flex_damping = 0.1;
  out->concealed.form = "mass on a spring that its weight bends";
  out->concealed.alike = {"actuator_ring"};
  out->concealed.truth = {{"natural_radps", out->form.flex_radps}};
  out->concealed.variables = {};
}

void Backlash(const Setting& s, Hidden* out) {
  out->form.gap_rad = s.Size(0.05, 0.022, 0.009);
  out->concealed.form = "two masses and a gap, the second held by its pin's friction";
  out->concealed.truth["gap_rad"] = Play_rad(out->form);
  out->concealed.variables = {};
}

void DriveFriction(const Setting& s, Hidden* out) {
  const double inertia_kgm2 = s.excavator.Inertias_kgm2(s.start_rad)[s.axis];
  AxisForm& form = out->form;
  form.weak_s = 0.04 + 0.1 * s.stream.Uniform(1);
  form.sliding_share = 0.5 + 0.35 * s.stream.Uniform(2);
  form.bristle_radps = 0.02 + 0.06 * s.stream.Uniform(3);
  const double lost_radps = s.Size(0.08, 0.045, 0.02);
  form.bristle_nm = lost_radps / (form.sliding_share * form.weak_s) * inertia_kgm2;
  out->concealed.form = "LuGre friction against a drive that gives way";
  // Static friction depends on how fast the effort grows, so the truth omits it.
  out->concealed.truth = {{"lost_radps", lost_radps}, {"time_s", form.weak_s}};
  // It sticks on the way out, and slides on the way back.
  out->concealed.variables.push_back(std::string("lever_way/") + kJoints[s.axis]);
}

std::string ChannelOf(std::size_t axis) { return fmt::format("encoders/{}_radps", kJoints[axis]); }

struct Effect {
  std::string name;
  bool (*on)(std::size_t axis);
  void (*hide)(const Setting&, Hidden*);
  bool is_load = false;  ///< of those, a joint has one
};

bool OnAny(std::size_t) { return true; }
bool OnQuick(std::size_t axis) { return axis != 0; }  // the slew's own mass is slower
bool OnPinned(std::size_t axis) { return axis == 1 || axis == 2; }
bool OnBucket(std::size_t axis) { return axis == 3; }

const std::vector<Effect>& Effects() {
  static const std::vector<Effect> effects = {
      {"dead_band", OnAny, DeadBand},
      {"command_delay", OnQuick, Delay},
      {"actuator_lag", OnQuick, Lag},
      {"rate_limit", OnQuick, RateLimit},
      {"lever_saturation", OnAny, Saturation},
      {"valve_curve", OnAny, ValveCurve},
      {"asymmetric_gain", OnQuick, AsymmetricGain},
      {"rate_gain", OnAny, Gain},
      {"input_hold", OnQuick, Hold},
      {"pressure_droop", OnPinned, Droop, true},
      {"cylinder_lever", OnPinned, Pins},
      {"structural_flex", OnQuick, Flex, true},
      {"backlash", OnBucket, Backlash, true},
      {"drive_friction", OnQuick, DriveFriction, true},
  };
  return effects;
}

const Effect& Named(const std::string& name) {
  const auto found = std::find_if(Effects().begin(), Effects().end(),
                                  [&](const Effect& effect) { return effect.name == name; });
  TERA_CHECK(found != Effects().end(), name);
  return *found;
}

}  // namespace

std::string_view NameOf(Strength strength) {
  switch (strength) {
    case Strength::kStrong:
      return "strong";
    case Strength::kMedium:
      return "medium";
    case Strength::kFaint:
      return "faint";
  }
  return "";
}

const std::vector<std::string>& NameableEffects() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Effect& effect : Effects()) list.push_back(effect.name);
    return list;
  }();
  return names;
}

bool CanHave(std::size_t axis, const std::string& name) { return Named(name).on(axis); }

bool GoTogether(const std::string& a, const std::string& b) {
  return a != b && !(Named(a).is_load && Named(b).is_load);
}

Hidden Hide(const std::string& name, Strength strength, std::size_t axis, const AxisForm& onto,
            const Excavator& excavator, const AxisValues& start_rad, const Stream& stream) {
  TERA_CHECK(CanHave(axis, name), name);
  Hidden hidden;
  hidden.form = onto;
  hidden.axis = axis;
  hidden.concealed.target = kJoints[axis];
  hidden.concealed.channels = {ChannelOf(axis)};
  hidden.concealed.name = name;
  hidden.concealed.variables = {fmt::format("lever/{}", kJoints[axis])};
  Named(name).hide({strength, axis, excavator, start_rad, stream}, &hidden);
  return hidden;
}

Hidden HideOutside(std::size_t axis, std::size_t other_axis, const Stream& stream) {
  Hidden hidden;
  Concealed& concealed = hidden.concealed;
  hidden.axis = axis;
  const std::string joint = kJoints[axis];
  concealed.target = joint;
  concealed.channels = {ChannelOf(axis)};
  const double kind = stream.Uniform(0), size = stream.Uniform(1);
  if (kind < 0.25) {
    hidden.form.warm_share = 0.25 + 0.2 * size;
    hidden.form.warm_s = 15;
    concealed.form = "oil that warms: slower by a share that decays in 15 s";
    concealed.variables = {"time"};
  } else if (kind < 0.5) {
    hidden.form.other_share = 0.35 + 0.2 * size;
    hidden.form.other_axis = other_axis;
    concealed.form = fmt::format("slower while the {}'s lever is out", kJoints[other_axis]);
    concealed.variables = {fmt::format("lever/{}", kJoints[other_axis])};
  } else if (kind < 0.75) {
    hidden.form.ripple_share = 0.2 + 0.15 * size;
    hidden.form.ripple_cycles = 8;
    concealed.form = "gain that goes up and down with the angle, 8 rad a radian";
    concealed.variables = {"position/" + joint};
  } else {
    hidden.form.spool_play = 0.12 + 0.1 * size;
    concealed.form =
        "spool that friction holds, 12 to 22 % of the lever wide, until springs centre it";
    concealed.variables = {"lever_way/" + joint};
  }
  return hidden;
}

}  // namespace tera::blind
