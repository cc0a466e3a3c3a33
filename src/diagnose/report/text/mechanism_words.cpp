#include "diagnose/report/text/mechanism_words.h"

#include <algorithm>
#include <string>

namespace tera {
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
    // Sensors: where they are, what they measure, when they say it was.
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
    // Mechanisms of the scene, whose sentences contain a place (sensor_text.h).
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
