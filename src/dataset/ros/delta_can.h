#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dataset/ros/messages.h"

namespace tera::ros {

/// A lever field of DeltaCAN, by its name in the message.
struct DeltaCanField {
  const char* name;
  float DeltaCan::*value;
};

inline constexpr DeltaCanField kDeltaCanFields[] = {{"slew", &DeltaCan::slew},
                                                    {"boom", &DeltaCan::boom},
                                                    {"arm", &DeltaCan::arm},
                                                    {"bucket", &DeltaCan::bucket},
                                                    {"left_travel", &DeltaCan::left_travel},
                                                    {"right_travel", &DeltaCan::right_travel},
                                                    {"blade", &DeltaCan::blade},
                                                    {"swing", &DeltaCan::swing}};

/// The field of a lever: the one of the same name; for a running gear's lever, `left_travel` or
/// `right_travel` by its name's beginning. Null if there is none.
float DeltaCan::*FieldOfLever(std::string_view name, bool drives_gear);

/// A machine's lever, in the order of its file.
struct NamedLever {
  std::string name;
  bool drives_gear = false;
};

/// The message for levers at `positions`: enabled, and at high speed, since recorded levers already
/// include a low speed. Stamps below 0 are 0.
DeltaCan DeltaCanOf(const std::vector<NamedLever>& levers, const std::vector<double>& positions,
                    TimeNs stamp_ns);

}  // namespace tera::ros
