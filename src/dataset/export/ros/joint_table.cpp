#include "dataset/export/ros/joint_table.h"

#include <algorithm>

namespace tera {

std::optional<std::size_t> ColumnOf(const std::vector<std::string>& columns,
                                    const std::string& column) {
  const auto found = std::find(columns.begin(), columns.end(), column);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

std::string WithoutEnding(const std::string& text, std::string_view ending) {
  return text.substr(0, text.size() - ending.size());
}

std::vector<JointColumns> JointColumnsOf(const std::vector<std::string>& columns,
                                         std::string_view position_ending,
                                         std::string_view rate_ending,
                                         std::string_view effort_ending) {
  std::vector<JointColumns> groups;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (!columns[c].ends_with(position_ending)) continue;
    const std::string name = WithoutEnding(columns[c], position_ending);
    const auto rate = ColumnOf(columns, name + std::string(rate_ending));
    const auto effort = ColumnOf(columns, name + std::string(effort_ending));
    if (rate && effort) groups.push_back({name, c, *rate, *effort});
  }
  return groups;
}

ros::JointState JointStateOf(const std::vector<JointColumns>& groups, const Record& record,
                             const std::string& frame_id, TimeNs stamp_ns) {
  ros::JointState message;
  message.header = {stamp_ns, frame_id};
  for (const JointColumns& group : groups) {
    message.name.push_back(group.name);
    message.position.push_back(record.values[group.position]);
    message.velocity.push_back(record.values[group.rate]);
    message.effort.push_back(record.values[group.effort]);
  }
  return message;
}

}  // namespace tera
