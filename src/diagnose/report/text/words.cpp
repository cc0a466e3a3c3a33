#include "diagnose/report/text/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace tera {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

/// Decimal exponent of a value other than 0: 2 for 523, -1 for 0.18.
int ExponentOf(double value) { return static_cast<int>(std::floor(std::log10(std::abs(value)))); }

/// Rounds a value to a power of ten and writes it without an exponent. Halves round away from 0,
/// even if the nearest double is slightly smaller than the half.
std::string Fixed(double value, int lowest_power) {
  constexpr double kBelowHalf = 1e-12;  // relative: thousands of times the resolution of a double
  value *= 1 + kBelowHalf;
  if (lowest_power <= 0) return fmt::format("{:.{}f}", value, -lowest_power);
  const double unit = std::pow(10.0, lowest_power);
  return fmt::format("{:.0f}", std::round(value / unit) * unit);
}

void DropZerosAtTheEnd(std::string* number) {
  if (number->find('.') == std::string::npos) return;
  number->erase(number->find_last_not_of('0') + 1);
  if (number->ends_with('.')) number->pop_back();
}

/// Quantities by the endings of column and parameter names. Longer endings come first.
constexpr std::pair<std::string_view, std::string_view> kQuantityOfEnding[] = {
    {"_radps2", "angular acceleration"},
    {"_mps2", "acceleration"},
    {"_degps", "rate"},
    {"_radps", "rate"},
    {"_mps", "speed"},
    {"_rad", "angle"},
    {"_deg", "angle"},
    {"_nm", "torque"},
    {"_n", "force"},
    {"_m", "position"}};

/// Endings of names that are units.
constexpr std::string_view kUnitEndings[] = {
    "_nmsprad", "_radpnm", "_radps2", "_radps", "_degps", "_degpk", "_mps2", "_degc",
    "_1ps",     "_mps",    "_mpk",    "_rad",   "_deg",   "_ppm",   "_nm",   "_kg",
    "_hz",      "_pa",     "_s",      "_m",     "_n",     "_w"};

/// Quantity of a column of an inertial unit or a receiver: "rate about x" for "wx_radps", "specific
/// force along z" for "az_mps2", "east position" for "east_m". Empty for other columns.
std::string TriadQuantityOf(std::string_view column) {
  if (column == "east_m" || column == "north_m" || column == "up_m") {
    return std::string(column.substr(0, column.size() - 2)) + " position";
  }
  if (column.size() < 2 || column[1] < 'x' || column[1] > 'z') return "";
  const std::string axis(1, column[1]);
  if (column.substr(2) == "_radps" && column[0] == 'w') return "rate about " + axis;
  if (column.substr(2) == "_mps2" && column[0] == 'a') return "specific force along " + axis;
  return "";
}

}  // namespace

ReadableUnit ReadableUnitOf(std::string_view unit) {
  if (unit == "1") return {1, ""};
  if (unit == "rad") return {kDegrees, "deg"};
  if (unit == "rad/s") return {kDegrees, "deg/s"};
  if (unit == "rad/s2" || unit == "rad/s^2") return {kDegrees, "deg/s²"};
  if (unit == "m/s2" || unit == "m/s^2") return {1, "m/s²"};
  return {1, std::string(unit)};
}

ReadableUnit ReadableUnitOf(const ParameterEstimate& parameter) {
  const bool is_frequency = parameter.name == "eta_radps" || parameter.name == "natural_radps";
  return is_frequency ? ReadableUnit{1, parameter.unit} : ReadableUnitOf(parameter.unit);
}

std::string WithUnit(const std::string& number, const ReadableUnit& unit) {
  return unit.name.empty() ? number : number + " " + unit.name;
}

std::string Significant(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return fmt::format("{}", value == 0 ? 0.0 : value);
  const int exponent = ExponentOf(value);
  if (exponent < -4 || exponent > 6) return fmt::format("{:.{}g}", value, digits);
  std::string text = Fixed(value, exponent - digits + 1);
  DropZerosAtTheEnd(&text);
  return text;
}

std::string Readable(double value, const ReadableUnit& unit) {
  return WithUnit(Significant(value * unit.factor, 2), unit);
}

std::string Readable(double value, std::string_view si_unit) {
  return Readable(value, ReadableUnitOf(si_unit));
}

std::string Change(double before, double after, const ReadableUnit& unit) {
  return Significant(before * unit.factor, 2) + " → " + Readable(after, unit);
}

std::string Change(double before, double after, std::string_view si_unit) {
  return Change(before, after, ReadableUnitOf(si_unit));
}

std::string WithSigma(double value, const std::optional<double>& sigma) {
  if (!sigma || !(*sigma > 0) || !std::isfinite(*sigma)) return Significant(value, 3);
  int power = ExponentOf(*sigma);
  if (std::round(*sigma / std::pow(10.0, power)) < 2) --power;
  if (power < -6) return fmt::format("{:.6g} ± {:.1g}", value, *sigma);
  return Fixed(value, power) + " ± " + Fixed(*sigma, power);
}

std::string ProbabilityText(double p) { return p < 1e-4 ? "p < 0.0001" : "p " + Significant(p, 2); }

std::string PercentText(double share) { return fmt::format("{:.0f} %", 100 * share); }

std::string TimeText(double time_s, double span_s) {
  return fmt::format("{:.{}f}", time_s, span_s >= 10 ? 0 : span_s >= 1 ? 1 : 2);
}

std::string IntervalsText(double from_s, double to_s, std::size_t more) {
  const double span_s = to_s - from_s;
  const std::string text = fmt::format("{}–{} s", TimeText(from_s, span_s), TimeText(to_s, span_s));
  if (more == 0) return text;
  return fmt::format("{} and {} more interval{}", text, more, more == 1 ? "" : "s");
}

std::string Spaced(std::string_view identifier) {
  std::string text(identifier);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string WithoutUnit(std::string_view key) {
  for (const std::string_view ending : kUnitEndings) {
    if (key.ends_with(ending) && key.size() > ending.size()) {
      return Spaced(key.substr(0, key.size() - ending.size()));
    }
  }
  return Spaced(key);
}

std::string QuantityOf(const std::string& channel) {
  const std::string_view column = std::string_view(channel).substr(channel.rfind('/') + 1);
  if (column == "left_mps") return "sideways speed";
  if (channel.ends_with("/poses/" + std::string(column)) && column.size() <= 2) {
    const std::string axis(1, column.back());
    return column.size() == 2 ? "turn of the poses about " + axis
                              : "place of the poses along " + axis;
  }
  if (const std::string triad = TriadQuantityOf(column); !triad.empty()) {
    const std::string folder = channel.substr(0, channel.size() - column.size() - 1);
    return Spaced(folder.substr(folder.rfind('/') + 1)) + " " + triad;
  }
  for (const auto& [ending, quantity] : kQuantityOfEnding) {
    if (column.ends_with(ending) && column.size() > ending.size()) {
      return Spaced(column.substr(0, column.size() - ending.size())) + " " + std::string(quantity);
    }
  }
  return Spaced(column);
}

std::string VariableText(const std::string& variable, const ReplayBlock& block) {
  const std::size_t slash = variable.find('/');
  if (slash == std::string::npos) return Spaced(variable);
  std::string kind = Spaced(variable.substr(0, slash));
  if (kind == "position" && UnitOfVariable(variable, block.channels.front().unit) == "rad") {
    kind = "angle";
  }
  const std::string owner = variable.substr(slash + 1);
  return owner == block.name ? kind : Spaced(owner) + " " + kind;
}

std::string UnitOfVariable(const std::string& variable, const std::string& channel_unit) {
  const bool slides = channel_unit == "m/s" || channel_unit == "m" || channel_unit == "N";
  const std::string kind = variable.substr(0, variable.find('/'));
  if (kind == "position") return slides ? "m" : "rad";
  if (kind == "load") return slides ? "N" : "N m";
  if (kind == "time") return "s";
  if (kind == "speed" || kind == "turning") return "m/s";
  if (kind == "rate") return slides ? "m/s" : "rad/s";
  if (kind == "acceleration") return slides ? "m/s^2" : "rad/s^2";
  if (kind == "force") return "m/s^2";
  if (kind == "pitch" || kind == "roll" || kind == "yaw" || kind == "slope") return "rad";
  if (kind == "yaw_rate") return "rad/s";
  return "1";
}

std::string Capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 32);
  return text;
}

std::string Listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return text;
}

namespace {

constexpr MechanismWords kWords[] = {
    // From the lever to the joint.
    {"command_delay", "command delay", "{The} answers its lever only after {delay_s}."},
    {"input_hold", "held command",
     "The lever of {the} is looked at only every {period_s}, and held in between."},
    {"command_drops", "command loss",
     "Of the messages from the lever of {the}, one every {period_s}, {probability%} are lost."},
    {"lever_saturation", "lever limit", "Beyond {limit%} of full lever {the} gets no faster."},
    {"dead_band", "dead band",
     "{The} does not move while its lever is within {width%} of neutral."},
    {"valve_curve", "valve curve",
     "At small levers {the} moves {exponent?slower?faster} than in proportion to the lever: its "
     "speed goes with the lever to the power of {exponent}."},
    {"asymmetric_gain", "asymmetric gain",
     "Under negative levers {the} moves {ratio~faster~slower} than under positive ones of the same "
     "size."},
    {"rate_gain", "rate gain",
     "At every lever {the} moves {gain~faster~slower} than the scenario says."},
    {"flow_sharing", "flow sharing",
     "{The} delivers {capacity%} of its nominal flow at most, so that what it feeds slows down "
     "while several functions move at once."},
    {"power_limit", "power limit",
     "{The} gives {power_w} at most, so that what it feeds slows down under load."},
    {"rate_limit", "rate limit",
     "The speed of {the} changes by {max_change_radps2} at most, whatever the lever asks for."},
    {"actuator_lag", "actuator lag",
     "{The} follows its lever gradually: two thirds of a change are reached after about {time_s}."},
    {"actuator_ring", "ringing",
     "After each change of its lever {the} swings at {eta_radps#}; the swing falls to a third in "
     "{beta_1ps^}."},
    {"end_cushion", "end cushion",
     "On its way into an end stop {the} is braked, from {zone_rad} before it on, to {end_ratio%} "
     "of "
     "its full speed at the stop."},
    {"cylinder_lever", "cylinder's lever arm",
     "At the same lever the speed of {the} depends on where it stands, as its cylinder's lever arm "
     "does; the scenario's speeds hold at {reference_rad}."},
    {"backlash", "backlash", "{The} has play: {gap_rad} of motion are lost at each reversal."},
    {"pressure_droop", "pressure droop",
     "Under load {the} moves slower, and faster where the load helps, than its lever asks for."},
    {"coulomb_friction", "dry friction",
     "Dry friction costs the drive of {the} {effort_nm} more at every speed."},
    {"viscous_friction", "viscous friction",
     "The faster {the} moves the more effort it costs: {coefficient_nmsprad}."},
    {"stribeck_friction", "sticking",
     "{The} sticks: setting it in motion takes {excess_nm} more than keeping it in motion."},
    {"asymmetric_friction", "friction by direction",
     "{The} has more friction in one direction than in the other: {numbers}."},
    {"effort_offset", "constant effort",
     "The effort of {the} is off by {effort_nm} both ways and at rest."},
    {"sag", "sag",
     "With its lever in neutral {the} creeps under its load, by {drift_radps} at full effort."},
    {"drive_friction", "drive friction",
     "Friction takes {lost_radps} from the speed of {the} at every lever, and small levers do not "
     "move it at all."},
    {"payload", "payload", "{The} carries {mass_kg} that the scenario does not have."},
    {"structural_flex", "flexing link", "{The} bends and swings by itself, at {natural_radps#}."},
    // Between the tracks and the motion of the machine.
    {"track_scale", "track scale",
     "For the same turning of the sprockets the tracks carry the machine {scale~farther~less "
     "far}."},
    {"track_asymmetry", "track asymmetry",
     "At the same turning of the sprockets the right track runs {difference%:faster:slower} than "
     "the left one, so that the machine drives a curve where it should drive straight on."},
    {"track_slip", "track slip",
     "The tracks slip, so that the machine does not go as far as they run: {numbers}."},
    {"slope_slip", "slip on slopes",
     "On slopes the tracks slip, by {slip_per_slope} times the gradient along the travel."},
    {"side_slip", "drift on slopes",
     "On a side slope the machine drifts sideways as it drives, by {drift_per_slope} times the "
     "gradient across the travel."},
    {"effective_gauge", "effective gauge",
     "The machine turns as if its tracks were {ratio} times as far apart: {ratio?less?more} than "
     "they ask for."},
    {"icr_shift", "turning point off",
     "The machine turns about a point that is off its middle: {numbers}."},
    {"rolling_resistance", "rolling resistance",
     "The ground resists rolling with {coefficient%} of the machine's weight, and the tracks slip "
     "under it."},
    {"digging_force", "dragged by digging",
     "Digging drags the machine over the ground, by {yield_mps} where it pulls one machine's "
     "weight "
     "more than the ground holds."},
    {"soil_strength", "strength of the soil",
     "The ground is not as strong as the scenario's, by these factors: {numbers}."},
    {"terrain_height", "height of the ground",
     "Around ({x_m}, {y_m}), within {radius_m}, the ground is {height_m:higher:lower} than in the "
     "scenario."},
    // Sensors: mounts, measurements and stamps.
    {"extrinsic", "mount off", "{The} is not mounted where its documentation says, by {numbers}."},
    {"mount_rotation", "turned mount", "{The} is turned against its documented mount: {numbers}."},
    {"axis_flip", "reversed sign", "{The} counts backwards{axes}."},
    {"imu_lever_arm", "place on the link",
     "{The} sits elsewhere on its link than documented, by {numbers}."},
    {"gnss_lever_arm", "place of the antenna",
     "The antenna of {the} sits elsewhere than documented, by {numbers}."},
    {"antenna_swap", "exchange of antennas",
     "The two antennas are exchanged: {the} has the other receiver's."},
    {"antenna_yaw", "turned pair of antennas",
     "The pair of antennas is turned by {yaw_deg}, so that the heading of {the} is off by as "
     "much."},
    {"bias", "constant error", "{The} is off by a constant, at rest too: {numbers}."},
    {"scale", "wrong scale", "{The} shows too much or too little in a fixed ratio: {numbers}."},
    {"saturation", "clipped range", "{The} clips what is beyond its range: {numbers}."},
    {"quantisation", "coarse step", "{The} measures in coarse steps: {numbers}."},
    {"outliers", "share of wild values", "Of the measurements of {the}, {probability%} are wild."},
    {"temperature_drift", "drift with temperature", "{The} drifts as it warms up: {numbers}."},
    {"vibration_rectification", "shift by vibration",
     "Vibration shifts the mean of what {the} measures: {numbers}."},
    {"height_datum", "height datum", "All heights of {the} are {offset_m:too high:too low}."},
    {"position_datum", "position datum",
     "All positions of {the} are shifted by the same amount: {numbers}."},
    {"float_jump", "lost fix",
     "About every {interval_s} {the} loses its fix for {duration_s}, and is then off by some "
     "{horizontal_m}."},
    {"multipath", "reflection",
     "Reflections from the raised boom shift what {the} says by up to {horizontal_m} sideways and "
     "{vertical_m} in height."},
    {"range_bias", "constant range error", "{The} measures every distance {0:too long:too short}."},
    {"clock_offset", "clock offset", "The clock of {the} is {offset_s:ahead:behind}."},
    {"clock_drift", "clock drift", "The clock of {the} runs {drift_ppm:fast:slow}."},
    {"latency", "delay of the stamps", "{The} stamps its measurements {delay_s} late."},
    {"filter_delay", "smoothing filter",
     "A filter smooths what {the} measures, and makes it late by about {time_constant_s}."},
    // Mechanisms of measured poses.
    {"arrival_stamps", "stamping on arrival",
     "The recorded poses bear the times at which they arrived, not those at which they were "
     "measured."},
    {"poses/latency", "delay of the poses",
     "The recorded poses are stamped {delay_s} after they were measured."},
    {"poses/mount_rotation", "leaning map",
     "The map of the recorded poses is not level: {numbers}."},
    // Mechanisms of the scene. Their sentences name a place (sensor_text.h).
    {"object_added", "unexpected thing", ""},
    {"object_missing", "missing thing", ""},
    {"dust", "dust", ""},
};

const MechanismWords* Find(std::string_view id) {
  const auto* const found =
      std::find_if(std::begin(kWords), std::end(kWords),
                   [&](const MechanismWords& words) { return words.id == id; });
  return found == std::end(kWords) ? nullptr : found;
}

}  // namespace

const MechanismWords* WordsOf(std::string_view id, std::string_view target) {
  const MechanismWords* of_target = Find(std::string(target) + "/" + std::string(id));
  return of_target != nullptr ? of_target : Find(id);
}

}  // namespace tera
