#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dataset/ros/messages.h"

namespace tera::ros {

/// A lever field of DeltaCAN, with its name in the message.
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

/// Field for a lever: the field of equal name or, for a lever of a running gear, `left_travel` or
/// `right_travel` according to the beginning of its name. Null if there is none.
float DeltaCan::*FieldOfLever(std::string_view name, bool drives_gear);

/// A lever of a machine, in the order of the machine file.
struct NamedLever {
  std::string name;
  bool drives_gear = false;
};

/// Message with the levers at `positions`. It is enabled and in high speed, because recorded lever
/// positions already include the effect of low speed. Negative stamps become 0.
DeltaCan DeltaCanOf(const std::vector<NamedLever>& levers, const std::vector<double>& positions,
                    TimeNs stamp_ns);

}  // namespace tera::ros
