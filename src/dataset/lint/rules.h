#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace tera {

/// Severity of a finding.
enum class Severity {
  kError,    ///< the dataset violates docs/reference/dataset.md or contradicts itself
  kWarning,  ///< valid, but probably unintended
  kNote      ///< worth knowing
};

/// Name of a severity, as in SARIF: "error", "warning", "note".
constexpr std::string_view NameOf(Severity severity) {
  switch (severity) {
    case Severity::kError:
      return "error";
    case Severity::kWarning:
      return "warning";
    case Severity::kNote:
      break;
  }
  return "note";
}

/// A rule of `tera lint`. Its id never changes, because programs and settings refer to it.
struct LintRule {
  std::string_view id;
  Severity severity;
  std::string_view text;    ///< the requirement
  std::string_view remedy;  ///< advice if the requirement is violated
};

inline constexpr std::array kLintRules = std::to_array<LintRule>({
    {"dataset.paths", Severity::kError,
     "Each channel of dataset.yaml is a path within the dataset and is listed once.",
     "Correct the list of channels."},
    {"dataset.instances", Severity::kError,
     "Instance ids are unique and at least 1, classes are listed, and a parent is another listed "
     "instance.",
     "Correct the list of instances."},
    {"dataset.epoch", Severity::kWarning, "The epoch is later than 1990, in nanoseconds.",
     "Correct since_1970_ns: a time in s or ms has too few digits."},
    {"dataset.unchecked", Severity::kError, "Every check can read its input.",
     "Correct the file that the message names."},

    {"files.missing", Severity::kError,
     "Each channel has its data.csv or table, and each frame that data.csv lists has its files.",
     "Restore the file, or remove its row or line from the list."},
    {"files.sheet", Severity::kError,
     "Each sensor has a sensor.yaml of the type that dataset.yaml names.",
     "Write sensor.yaml as in docs/reference/dataset.md."},
    {"files.extra", Severity::kWarning, "Frame folders hold only frames that data.csv lists.",
     "Delete the extra file, or list it."},
    {"files.unknown", Severity::kWarning,
     "docs/reference/dataset.md defines every file and folder.",
     "Move it out of the dataset, or list its channel."},
    {"files.hash", Severity::kError, "Every file has the digest that frames.sha256 lists.",
     "Copy the file again; if the change is intended, delete frames.sha256 and write it again."},

    {"rows.header", Severity::kError,
     "The first line of a table is t_ns and the columns of the channel's type.",
     "Write the header as in docs/reference/dataset.md."},
    {"rows.fields", Severity::kError,
     "Each row is complete and has one number for each column of the header.",
     "Record or copy the file again; an incomplete last line may be deleted."},
    {"rows.finite", Severity::kError, "No number is NaN or infinite.",
     "Remove the row: a missing measurement has no row."},
    {"rows.filename", Severity::kError,
     "The file name of a frame is its t_ns with the extension of its kind.",
     "Give the frame's files and its row the same t_ns."},

    {"stamps.increasing", Severity::kError, "t_ns increases from row to row.",
     "Sort the rows and remove duplicates."},
    {"stamps.gap", Severity::kWarning,
     "No row is missing at the rate of sensor.yaml, or else at the median rate of the table.",
     "Find the cause of the loss: a full buffer, a bus or a disk."},
    {"stamps.rate", Severity::kWarning, "The median interval matches the rate in sensor.yaml.",
     "Correct rate_hz, or the unit of the stamps."},
    {"stamps.coverage", Severity::kWarning,
     "Each channel lies within the recording's duration and fills it.",
     "Correct duration_s, or the channel's time base."},

    {"places.far", Severity::kWarning, "Poses and fixes lie within 100 km of the origin.",
     "Give the import an origin near the machine, or give poses a world that moves map coordinates "
     "there."},

    {"poses.quaternion", Severity::kError, "Quaternions of poses have norm 1 and w >= 0.",
     "Normalise them; check the order, w first."},
    {"poses.velocity", Severity::kWarning,
     "Velocities and rates of poses match the change of position and orientation.",
     "Check units and frames: v in W, w in B."},
    {"poses.ground", Severity::kWarning, "No machine falls freely or lies metres below all ground.",
     "Give it tracks, wheels or hull_points; check heights and origin of the poses."},

    {"commands.range", Severity::kError, "Lever values lie in -1 to +1.",
     "Scale them; divide per cent by 100."},
    {"encoders.rates", Severity::kWarning, "Encoder rates match the change of encoder positions.",
     "Check units (rad, rad/s), signs and order of the columns."},
    {"encoders.jump", Severity::kWarning,
     "Joint angles never jump by more than half a turn from row to row.",
     "Import an angle that wraps after a turn with wrap_deg: 360; remove wrong rows."},
    {"encoders.radians", Severity::kWarning,
     "Angles and rates of joints are plausible as rad and rad/s.", "Convert degrees to radians."},
    {"encoders.truth", Severity::kWarning, "Encoder positions match truth/<machine>/joints.csv.",
     "Check names, units and zero positions of the joints."},

    {"events.rows", Severity::kError,
     "Events are whole rows of a known kind and unit, in order of their beginning, within the "
     "recording and of its machines.",
     "Copy the file again, or generate the recording again."},

    {"imu.gravity", Severity::kError,
     "An inertial unit's specific force has about the magnitude of gravity.",
     "Convert to m/s2; 1 g is 9.80665. If gravity was subtracted, record the raw specific force."},
    {"imu.units", Severity::kWarning,
     "An inertial unit's rates match the rotation of gravity in its frame.",
     "State the unit of the rates in the import: rad/s or deg/s."},
    {"imu.down", Severity::kWarning,
     "An inertial unit's specific force does not point down all the time, unless its mount is "
     "upside down.",
     "Turn its axes at the import with rpy_deg: [180, 0, 0], or give it an upside-down mount."},
    {"imu.rates", Severity::kWarning,
     "An inertial unit's rates match the recorded poses of its link.",
     "Check the unit (rad/s, not deg/s), the axes and X_parent_sensor."},
    {"imu.up", Severity::kWarning,
     "An inertial unit's specific force, turned into the world by the recorded poses, points up.",
     "Check the axes and X_parent_sensor."},

    {"gnss.values", Severity::kError,
     "Fixes are GGA qualities; latitudes, longitudes and variances are within their ranges.",
     "Check the order and units of the columns; remove rows without a measurement."},
    {"gnss.geodesy", Severity::kError,
     "East, north and up match latitude, longitude and height relative to the dataset's origin.",
     "Check the origin, and that heights are above the ellipsoid."},
    {"gnss.pose", Severity::kWarning,
     "A receiver's position is within reach of its machine's recorded pose.",
     "Check the origin and the world of the poses."},

    {"pictures.readable", Severity::kError,
     "Each picture is a complete PNG with the bits and components of its kind.",
     "Write the file again."},
    {"pictures.size", Severity::kError, "All pictures of a camera have the size in sensor.yaml.",
     "Correct width_px and height_px, or render again."},
    {"pictures.classes", Severity::kError, "Pixels of semantic/ are classes of dataset.yaml.",
     "Add the class to the list, or label again."},
    {"pictures.instances", Severity::kError,
     "Pixels of instance/ are 0 or instances of dataset.yaml.",
     "Add the instance to the list, or label again."},
    {"pictures.agree", Severity::kError,
     "A pixel's class in semantic/ is the class of its instance; panoptic/ repeats class and "
     "instance.",
     "Render both from the same scene; check the list of instances."},
    {"pictures.depth", Severity::kError,
     "Sky pixels have neither depth nor distance; distance is at least depth.",
     "Check the unit (mm); check that all pictures have the same time."},
    {"pictures.normals", Severity::kError, "Normals have length 1 or are 0 0 0.",
     "Write n as round(32767 (n + 1))."},
    {"pictures.flow", Severity::kError,
     "The third value of flow is 0 to 3; all flow of the first picture is 0.",
     "Write the flow states of docs/reference/dataset.md."},
    {"pictures.motion", Severity::kWarning,
     "The ground's flow to the previous picture matches distance and camera poses.",
     "Check the signs and order of the flow, the poses and the order of the frames."},

    {"boxes.readable", Severity::kError,
     "Each file of boxes is JSON as in docs/reference/dataset.md.", "Write the file again."},
    {"boxes.instance", Severity::kError,
     "A box has the name, class and parent of its instance in dataset.yaml; an instance has one "
     "box at most.",
     "Correct the box or the list of instances."},
    {"boxes.bounds", Severity::kError,
     "Boxes lie in the picture; visibility and truncation lie in 0 to 1.",
     "Write bounds in whole pixels, the last one inclusive."},
    {"boxes.mask", Severity::kError,
     "Bounds and visible_px of a box match its pixels in instance/; each instance in the picture "
     "has a box.",
     "Write boxes and masks from the same picture."},

    {"scans.readable", Severity::kError,
     "Each scan is a complete PCD with the fields of docs/reference/dataset.md.",
     "Write the file again."},
    {"scans.values", Severity::kError,
     "Points are finite, intensities lie in 0 to 1, times within the revolution.",
     "Remove rays without a return; scale intensities; count times from the scan's t_ns."},
    {"scans.classes", Severity::kError, "Labels of points are classes of dataset.yaml.",
     "Add the class to the list, or label again."},
    {"scans.instances", Severity::kError,
     "Instances of points are 0 or instances of dataset.yaml with the class of the point.",
     "Add the instance to the list, or label again."},
    {"scans.depth", Severity::kWarning,
     "A scan and a depth picture of one machine and time agree on surfaces that both see.",
     "Check X_parent_sensor of both, the units and the clocks."},
});

/// A rule, given by its id. An unknown id is a compile error.
class RuleId {
 public:
  consteval RuleId(const char* id) : index_(Find(id)) {}  // NOLINT(google-explicit-constructor)
  constexpr std::size_t index() const { return index_; }
  constexpr const LintRule& rule() const { return kLintRules[index_]; }

 private:
  static consteval std::size_t Find(std::string_view id) {
    for (std::size_t i = 0; i < kLintRules.size(); ++i) {
      if (kLintRules[i].id == id) return i;
    }
    throw "there is no such rule";
  }
  std::size_t index_;
};

}  // namespace tera
