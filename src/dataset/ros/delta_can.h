#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dataset/ros/messages.h"

namespace tera::ros {

/// A field of DeltaCAN that is a lever, by its name in the message.
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

/// Which field moves a lever: that of its own name; for the lever of a running gear, `left_travel`
/// or `right_travel` by how its name begins. Null where there is none.
float DeltaCan::*FieldOfLever(std::string_view name, bool drives_gear);

/// A machine's lever, in the order of its file.
struct NamedLever {
  std::string name;
  bool drives_gear = false;
};

/// The message under which a machine's levers stand at `positions`: enabled, and at high speed, as
/// levers that were recorded have a low speed in them already. Stamps before 0 are 0.
DeltaCan DeltaCanOf(const std::vector<NamedLever>& levers, const std::vector<double>& positions,
                    TimeNs stamp_ns);

}  // namespace tera::ros
