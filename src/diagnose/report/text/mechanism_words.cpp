#include "diagnose/report/text/mechanism_words.h"

#include <algorithm>
#include <string>

namespace tera {
namespace {

constexpr MechanismWords kWords[] = {
    // From the lever to the joint.
    {"command_delay", "command delay", "a lever that is answered late",
     "{The} answers its lever only after {delay_s}."},
    {"input_hold", "held command", "a lever that is looked at only now and then",
     "The lever of {the} is looked at only every {period_s}, and held in between."},
    {"command_drops", "command loss", "messages from the lever that are lost",
     "Of the messages from the lever of {the}, one every {period_s}, {probability%} are lost."},
    {"lever_saturation", "lever limit", "a lever or spool that ends early",
     "Beyond {limit%} of full lever {the} gets no faster."},
    {"dead_band", "dead band", "a valve that stays shut near neutral",
     "{The} does not move while its lever is within {width%} of neutral."},
    {"valve_curve", "valve curve", "a valve that does not open in proportion to the lever",
     "At small levers {the} moves {exponent?slower?faster} than in proportion to the lever: its "
     "speed goes with the lever to the power of {exponent}."},
    {"asymmetric_gain", "asymmetric gain", "a speed that differs by the side of the lever",
     "Under negative levers {the} moves {ratio~faster~slower} than under positive ones of the same "
     "size."},
    {"rate_gain", "rate gain", "a speed that is off in the same ratio at every lever",
     "At every lever {the} moves {gain~faster~slower} than the scenario says."},
    {"flow_sharing", "flow sharing",
     "a pump that has too little flow for several functions at once",
     "{The} delivers {capacity%} of its nominal flow at most, so that what it feeds slows down "
     "while several functions move at once."},
    {"power_limit", "power limit", "a pump that gives way under load",
     "{The} gives {power_w} at most, so that what it feeds slows down under load."},
    {"rate_limit", "rate limit", "a speed that changes only so fast",
     "The speed of {the} changes by {max_change_radps2} at most, whatever the lever asks for."},
    {"actuator_lag", "actuator lag", "a drive that follows gradually",
     "{The} follows its lever gradually: two thirds of a change are reached after about {time_s}."},
    {"actuator_ring", "ringing", "a drive that swings after each change of the lever",
     "After each change of its lever {the} swings at {eta_radps#}; the swing falls to a third in "
     "{beta_1ps^}."},
    {"end_cushion", "end cushion", "a cylinder that is braked at its ends",
     "On its way into an end stop {the} is braked, from {zone_rad} before it on, to {end_ratio%} "
     "of "
     "its full speed at the stop."},
    {"cylinder_lever", "cylinder's lever arm", "a speed that depends on where the joint stands",
     "At the same lever the speed of {the} depends on where it stands, as its cylinder's lever arm "
     "does; the scenario's speeds hold at {reference_rad}."},
    {"backlash", "backlash", "play that is lost at each reversal",
     "{The} has play: {gap_rad} of motion are lost at each reversal."},
    {"pressure_droop", "pressure droop", "a speed that falls under load",
     "Under load {the} moves slower, and faster where the load helps, than its lever asks for."},
    {"coulomb_friction", "dry friction", "friction that is the same at every speed",
     "Dry friction costs the drive of {the} {effort_nm} more at every speed."},
    {"viscous_friction", "viscous friction", "friction that grows with the speed",
     "The faster {the} moves the more effort it costs: {coefficient_nmsprad}."},
    {"stribeck_friction", "sticking", "friction that is largest as motion begins",
     "{The} sticks: setting it in motion takes {excess_nm} more than keeping it in motion."},
    {"asymmetric_friction", "friction by direction", "friction that differs by direction",
     "{The} has more friction in one direction than in the other: {numbers}."},
    {"effort_offset", "constant effort", "an effort that is off by a constant",
     "The effort of {the} is off by {effort_nm} both ways and at rest."},
    {"sag", "sag", "a leak through which the load moves the joint",
     "With its lever in neutral {the} creeps under its load, by {drift_radps} at full effort."},
    {"drive_friction", "drive friction", "friction that a soft drive does not make up for",
     "Friction takes {lost_radps} from the speed of {the} at every lever, and small levers do not "
     "move it at all."},
    {"payload", "payload", "a load that the scenario does not have",
     "{The} carries {mass_kg} that the scenario does not have."},
    {"structural_flex", "flexing link", "a link that bends and swings",
     "{The} bends and swings by itself, at {natural_radps#}."},
    // Between the tracks and the motion of the machine.
    {"track_scale", "track scale", "tracks that run farther or less far than their sprockets say",
     "For the same turning of the sprockets the tracks carry the machine {scale~farther~less "
     "far}."},
    {"track_asymmetry", "track asymmetry", "one track that runs faster than the other",
     "At the same turning of the sprockets the right track runs {difference%:faster:slower} than "
     "the left one, so that the machine drives a curve where it should drive straight on."},
    {"track_slip", "track slip", "tracks that slip",
     "The tracks slip, so that the machine does not go as far as they run: {numbers}."},
    {"slope_slip", "slip on slopes", "tracks that slip on slopes",
     "On slopes the tracks slip, by {slip_per_slope} times the gradient along the travel."},
    {"side_slip", "drift on slopes", "sliding sideways on side slopes",
     "On a side slope the machine drifts sideways as it drives, by {drift_per_slope} times the "
     "gradient across the travel."},
    {"effective_gauge", "effective gauge", "tracks that turn as if they were farther apart",
     "The machine turns as if its tracks were {ratio} times as far apart: {ratio?less?more} than "
     "they ask for."},
    {"icr_shift", "turning point off", "turning about another point than the middle",
     "The machine turns about a point that is off its middle: {numbers}."},
    {"rolling_resistance", "rolling resistance", "ground that resists rolling",
     "The ground resists rolling with {coefficient%} of the machine's weight, and the tracks slip "
     "under it."},
    {"digging_force", "dragged by digging", "digging that drags the machine",
     "Digging drags the machine over the ground, by {yield_mps} where it pulls one machine's "
     "weight "
     "more than the ground holds."},
    {"soil_strength", "strength of the soil", "soil that is stronger or weaker",
     "The ground is not as strong as the scenario's, by these factors: {numbers}."},
    {"terrain_height", "height of the ground", "ground that is higher or lower",
     "Around ({x_m}, {y_m}), within {radius_m}, the ground is {height_m:higher:lower} than in the "
     "scenario."},
    // Sensors: where they are, what they measure, when they say it was.
    {"extrinsic", "mount off", "a mount that is not as documented",
     "{The} is not mounted where its documentation says, by {numbers}."},
    {"mount_rotation", "turned mount", "a sensor that is turned in its mount",
     "{The} is turned against its documented mount: {numbers}."},
    {"axis_flip", "reversed sign", "an axis that counts backwards",
     "{The} counts backwards{axes}."},
    {"imu_lever_arm", "place on the link", "a sensor that sits elsewhere on its link",
     "{The} sits elsewhere on its link than documented, by {numbers}."},
    {"gnss_lever_arm", "place of the antenna", "an antenna that sits elsewhere",
     "The antenna of {the} sits elsewhere than documented, by {numbers}."},
    {"antenna_swap", "exchange of antennas", "two antennas that are exchanged",
     "The two antennas are exchanged: {the} has the other receiver's."},
    {"antenna_yaw", "turned pair of antennas", "a pair of antennas that is turned",
     "The pair of antennas is turned by {yaw_deg}, so that the heading of {the} is off by as "
     "much."},
    {"bias", "constant error", "a measurement that is off by a constant",
     "{The} is off by a constant, at rest too: {numbers}."},
    {"scale", "wrong scale", "a measurement that is off by a factor",
     "{The} shows too much or too little in a fixed ratio: {numbers}."},
    {"saturation", "clipped range", "a sensor that clips large values",
     "{The} clips what is beyond its range: {numbers}."},
    {"quantisation", "coarse step", "a sensor that measures in coarse steps",
     "{The} measures in coarse steps: {numbers}."},
    {"outliers", "share of wild values", "single measurements that are wild",
     "Of the measurements of {the}, {probability%} are wild."},
    {"temperature_drift", "drift with temperature", "a sensor that drifts as it warms up",
     "{The} drifts as it warms up: {numbers}."},
    {"vibration_rectification", "shift by vibration", "vibration that shifts the mean",
     "Vibration shifts the mean of what {the} measures: {numbers}."},
    {"height_datum", "height datum", "heights that count from another zero",
     "All heights of {the} are {offset_m:too high:too low}."},
    {"position_datum", "position datum", "positions that count from another zero",
     "All positions of {the} are shifted by the same amount: {numbers}."},
    {"float_jump", "lost fix", "a receiver that loses its fix",
     "About every {interval_s} {the} loses its fix for {duration_s}, and is then off by some "
     "{horizontal_m}."},
    {"multipath", "reflection", "reflections from the raised boom",
     "Reflections from the raised boom shift what {the} says by up to {horizontal_m} sideways and "
     "{vertical_m} in height."},
    {"range_bias", "constant range error", "distances that are off by a constant",
     "{The} measures every distance {0:too long:too short}."},
    {"clock_offset", "clock offset", "a clock that is ahead or behind",
     "The clock of {the} is {offset_s:ahead:behind}."},
    {"clock_drift", "clock drift", "a clock that runs fast or slow",
     "The clock of {the} runs {drift_ppm:fast:slow}."},
    {"latency", "delay of the stamps", "measurements that are stamped late",
     "{The} stamps its measurements {delay_s} late."},
    {"filter_delay", "smoothing filter", "a filter that smooths and delays",
     "A filter smooths what {the} measures, and makes it late by about {time_constant_s}."},
    // Mechanisms of measured poses.
    {"arrival_stamps", "stamping on arrival", "poses that are stamped as they arrive",
     "The recorded poses bear the times at which they arrived, not those at which they were "
     "measured."},
    {"poses/latency", "delay of the poses", "poses that are stamped late",
     "The recorded poses are stamped {delay_s} after they were measured."},
    {"poses/mount_rotation", "leaning map", "a map that is not level",
     "The map of the recorded poses is not level: {numbers}."},
    // Mechanisms of the scene, whose sentences contain a place (perception_text.h).
    {"object_added", "unexpected thing", "a thing that the scenario does not have", ""},
    {"object_missing", "missing thing", "a thing that is not there", ""},
    {"dust", "dust", "dust in the air", ""},
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
