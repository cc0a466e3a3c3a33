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
     "Ids of instances are unique and from 1, their classes stand in the list of classes, and a "
     "parent is another instance of the list.",
     "Correct the list of instances."},
    {"dataset.epoch", Severity::kWarning, "The epoch is later than 1990, in nanoseconds.",
     "Correct since_1970_ns: of a time in s or ms it has too few digits."},
    {"dataset.unchecked", Severity::kError, "Every check can read what it needs.",
     "Put the file right that the message names."},

    {"files.missing", Severity::kError,
     "Each channel has its data.csv or table, and each frame that data.csv names has its files.",
     "Put the file back, or take its row or line out of the list."},
    {"files.sheet", Severity::kError,
     "Each sensor has a sensor.yaml of the type that dataset.yaml names.",
     "Write sensor.yaml as docs/reference/dataset.md says."},
    {"files.extra", Severity::kWarning,
     "The folders of frames hold nothing but the frames that data.csv names.",
     "Delete what is left over, or list it."},
    {"files.unknown", Severity::kWarning,
     "Every file and folder is one that docs/reference/dataset.md knows.",
     "Move it out of the dataset, or list its channel."},
    {"files.hash", Severity::kError,
     "The files are those that frames.sha256 was written of, byte for byte.",
     "Copy the file again; where the change is meant, delete frames.sha256 and write it anew."},

    {"rows.header", Severity::kError,
     "The first line of a table is t_ns and the columns of the channel's type.",
     "Write the header as docs/reference/dataset.md says."},
    {"rows.fields", Severity::kError,
     "Each row is whole and has as many numbers as the header has columns.",
     "Record or copy the file again; a cut last line may be deleted."},
    {"rows.finite", Severity::kError, "No number is NaN or infinite.",
     "Leave the row out: where there is no measurement there is no row."},
    {"rows.filename", Severity::kError,
     "The name of a frame is its t_ns with the ending of its kind.",
     "Name the frame's files and its row alike."},

    {"stamps.increasing", Severity::kError, "t_ns grows from row to row.",
     "Sort the rows and leave out what is there twice."},
    {"stamps.gap", Severity::kWarning,
     "Rows follow each other at the rate of sensor.yaml, or of the table's own median, without one "
     "missing.",
     "Find what was lost: a full buffer, a bus, a disk."},
    {"stamps.rate", Severity::kWarning, "The median interval is that of the rate in sensor.yaml.",
     "Correct rate_hz, or the unit of the stamps."},
    {"stamps.coverage", Severity::kWarning,
     "Each channel lies within the recording's duration and fills it.",
     "Correct duration_s, or the channel's time base."},

    {"places.far", Severity::kWarning, "Poses and fixes lie within 100 km of the origin.",
     "Give the import an origin near the machine, or poses a world that takes a map's coordinates "
     "to it."},

    {"poses.quaternion", Severity::kError, "Quaternions of poses have norm 1 and w >= 0.",
     "Normalise them; check the order, w first."},
    {"poses.velocity", Severity::kWarning,
     "Velocities and rates of poses are the change of position and orientation.",
     "Check units and frames: v in W, w in B."},
    {"poses.ground", Severity::kWarning,
     "A machine neither falls freely nor is metres below all ground.",
     "Give it tracks, wheels or hull_points; check heights and origin of the poses."},

    {"commands.range", Severity::kError, "Levers lie in -1 to +1.",
     "Scale them; percent are hundredths."},
    {"encoders.rates", Severity::kWarning, "Rates of encoders are the change of their positions.",
     "Check units (rad, rad/s), signs and order of the columns."},
    {"encoders.jump", Severity::kWarning,
     "Angles of joints go on from row to row, without a jump by more than half a turn.",
     "Import an angle that begins anew after a turn with wrap_deg: 360; leave wrong rows out."},
    {"encoders.radians", Severity::kWarning,
     "Angles and rates of joints are plausible as rad and rad/s.", "Convert degrees to radians."},
    {"encoders.truth", Severity::kWarning,
     "Encoders read the joints that truth/<machine>/joints.csv tells.",
     "Check names, units and zero positions of the joints."},

    {"imu.gravity", Severity::kError,
     "An inertial unit's specific force has about the size of gravity.",
     "Convert to m/s2; 1 g is 9.80665. Where gravity was taken away, record it with it."},
    {"imu.units", Severity::kWarning, "An inertial unit turns by its rates as gravity turns in it.",
     "Give the import the unit of the rates: rad/s or deg/s."},
    {"imu.down", Severity::kWarning,
     "An inertial unit's specific force does not point down all the time, but where its mount says "
     "that it hangs upside down.",
     "Turn its axes at the import, rpy_deg: [180, 0, 0], or give it a mount that says so."},
    {"imu.rates", Severity::kWarning,
     "An inertial unit turns as its link does by the recorded poses.",
     "Check the unit (rad/s, not deg/s), the axes and X_parent_sensor."},
    {"imu.up", Severity::kWarning,
     "An inertial unit's specific force points up where the recorded poses turn it into the world.",
     "Check the axes and X_parent_sensor."},

    {"gnss.values", Severity::kError,
     "Fixes are qualities of GGA; latitudes, longitudes and variances are possible.",
     "Check the order and units of the columns; leave out rows that are no measurement."},
    {"gnss.geodesy", Severity::kError,
     "East, north and up are latitude, longitude and height about the dataset's origin.",
     "Check the origin, and that heights are above the ellipsoid."},
    {"gnss.pose", Severity::kWarning,
     "A receiver lies within reach of its machine's recorded pose.",
     "Check the origin and the world of the poses."},

    {"pictures.readable", Severity::kError,
     "Each picture is a whole PNG of the bits and components of its kind.",
     "Write the file again."},
    {"pictures.size", Severity::kError,
     "All pictures of a camera have the size that sensor.yaml tells.",
     "Correct width_px and height_px, or render again."},
    {"pictures.classes", Severity::kError, "Pixels of semantic/ are classes of dataset.yaml.",
     "Add the class to the list, or label again."},
    {"pictures.instances", Severity::kError,
     "Pixels of instance/ are 0 or instances of dataset.yaml.",
     "Add the instance to the list, or label again."},
    {"pictures.agree", Severity::kError,
     "A pixel's class in semantic/ is that of its instance; panoptic/ has the same of both.",
     "Render both from the same scene; check the list of instances."},
    {"pictures.depth", Severity::kError,
     "Where the class is sky there is neither depth nor distance, and distance is no less than "
     "depth.",
     "Check the unit (mm), and that all pictures are of one instant."},
    {"pictures.normals", Severity::kError, "Normals have length 1 or are 0 0 0.",
     "Write n as round(32767 (n + 1))."},
    {"pictures.flow", Severity::kError,
     "The third value of flow is 0 to 3, and all is 0 of the first picture.",
     "Write the states of docs/reference/dataset.md."},
    {"pictures.motion", Severity::kWarning,
     "The ground's flow to the previous picture follows from distance and the camera's poses.",
     "Check signs and order of the flow, the poses, and that frames lie in order."},

    {"boxes.readable", Severity::kError,
     "Each file of boxes is JSON as docs/reference/dataset.md says.", "Write the file again."},
    {"boxes.instance", Severity::kError,
     "A box has the name, class and parent that dataset.yaml gives its instance, and is there "
     "once.",
     "Correct the box or the list of instances."},
    {"boxes.bounds", Severity::kError, "Boxes lie in the picture, and shares lie in 0 to 1.",
     "Write bounds in whole pixels, the last one inclusive."},
    {"boxes.mask", Severity::kError,
     "Bounds and visible_px of a box are those of its pixels in instance/, and each instance in "
     "the "
     "picture has a box.",
     "Write boxes and masks from the same picture."},

    {"scans.readable", Severity::kError,
     "Each scan is a whole PCD with the fields of docs/reference/dataset.md.",
     "Write the file again."},
    {"scans.values", Severity::kError,
     "Points are finite, intensities lie in 0 to 1, times within the revolution.",
     "Leave out rays without return; scale intensities; count times from the scan's t_ns."},
    {"scans.classes", Severity::kError, "Labels of points are classes of dataset.yaml.",
     "Add the class to the list, or label again."},
    {"scans.instances", Severity::kError,
     "Instances of points are 0 or stand in dataset.yaml, with the class of the point.",
     "Add the instance to the list, or label again."},
    {"scans.depth", Severity::kWarning,
     "A scan and a depth picture of the same time and machine agree where both see.",
     "Check X_parent_sensor of both, units, and the clocks."},
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
