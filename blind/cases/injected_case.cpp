#include "blind/cases/injected_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "blind/cases/tracks_case.h"
#include "core/check.h"
#include "core/error.h"

namespace tera::blind {
namespace {

constexpr double kWheel_m = 0.3;
constexpr double kNoise_mps = 0.05;  ///< about that of differences of the reference's poses

using Row = std::map<std::string, double>;

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

double Number(const Row& row, const std::string& column, const std::filesystem::path& csv) {
  const auto found = row.find(column);
  if (found != row.end()) return found->second;
  throw InputError(fmt::format("{}: no number in column '{}'; need the drive that ships with TERA",
                               csv.string(), column));
}

/// Cells that are no numbers are left out.
std::vector<Row> RowsOf(const std::filesystem::path& csv) {
  std::ifstream stream(csv);
  std::string line;
  if (!std::getline(stream, line)) {
    throw InputError(fmt::format("{}: cannot be read; need the real drive", csv.string()));
  }
  const std::vector<std::string> columns = Cells(line);
  std::vector<Row> rows;
  while (std::getline(stream, line)) {
    const std::vector<std::string> cells = Cells(line);
    Row& row = rows.emplace_back();
    for (std::size_t c = 0; c < std::min(cells.size(), columns.size()); ++c) {
      char* end = nullptr;
      const double number = std::strtod(cells[c].c_str(), &end);
      if (end != cells[c].c_str()) row[columns[c]] = number;
    }
  }
  return rows;
}

long long Nanoseconds(double t_s) { return std::llround(t_s * 1e6) * 1000; }

}  // namespace

RealDrive RealDrive::Read(const std::filesystem::path& csv) {
  RealDrive drive;
  drive.poses.columns = {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"};
  double index = 0;
  for (const Row& row : RowsOf(csv)) {
    const auto at = [&](const std::string& column) { return Number(row, column, csv); };
    drive.t_s.push_back(at("t_s"));
    drive.left_radps.push_back(at("meas_left_vel"));
    drive.right_radps.push_back(at("meas_right_vel"));
    if (at("icp_index") <= 0 || at("icp_index") == index) continue;
    index = at("icp_index");
    drive.poses.t_ns.push_back(Nanoseconds(at("t_s")));
    drive.poses.rows.push_back({at("icp_pos_x"), at("icp_pos_y"), at("icp_pos_z"), at("icp_quat_w"),
                                at("icp_quat_x"), at("icp_quat_y"), at("icp_quat_z")});
  }
  return drive;
}

RealDrive RealDrive::Part(double from_s, double length_s) const {
  RealDrive part;
  part.poses.columns = poses.columns;
  const auto is_in = [&](double t) { return t >= from_s && t < from_s + length_s; };
  for (std::size_t k = 0; k < t_s.size(); ++k) {
    if (!is_in(t_s[k])) continue;
    part.t_s.push_back(t_s[k] - from_s);
    part.left_radps.push_back(left_radps[k]);
    part.right_radps.push_back(right_radps[k]);
  }
  for (std::size_t k = 0; k < poses.t_ns.size(); ++k) {
    const double t = static_cast<double>(poses.t_ns[k]) * 1e-9;
    if (!is_in(t)) continue;
    part.poses.t_ns.push_back(Nanoseconds(t - from_s));
    part.poses.rows.push_back(poses.rows[k]);
  }
  return part;
}

bool IsOfRealDrive(const std::string& target, const std::string& mechanism) {
  if (target == "base") return mechanism == "track_asymmetry";
  return target == "poses" && (mechanism == "arrival_stamps" || mechanism == "latency");
}

const std::vector<std::string>& NameableInRealDrives() {
  static const std::vector<std::string> names = {"track_asymmetry", "track_scale"};
  return names;
}

Concealed HideInRealDrive(const std::string& name, Strength strength, const Stream& stream,
                          InjectedCase* out) {
  // A wheel of a smaller circumference turns more often for the same way.
  TrackForm form;
  Concealed concealed = HideInTracks(name, strength, stream, &form);
  out->left = 1 / form.worn_left;
  out->right = 1 / form.worn_right;
  concealed.form = "rates of a real vehicle's wheels, times a factor a side";
  return concealed;
}

CaseRecording RecordInjected(const InjectedCase& injected) {
  const RealDrive& drive = injected.drive;
  CaseRecording recording;
  recording.encoders.columns = {"left_track_rad", "right_track_rad", "left_track_radps",
                                "right_track_radps"};
  recording.poses = drive.poses;
  Change& change = recording.changes.emplace_back();
  double left_rad = 0, right_rad = 0;
  for (std::size_t k = 0; k < drive.t_s.size(); ++k) {
    const double step_s = k > 0 ? drive.t_s[k] - drive.t_s[k - 1] : 0;
    const double left = injected.left * drive.left_radps[k];
    const double right = injected.right * drive.right_radps[k];
    left_rad += step_s * left;
    right_rad += step_s * right;
    recording.encoders.t_ns.push_back(Nanoseconds(drive.t_s[k]));
    recording.encoders.rows.push_back({left_rad, right_rad, left, right});
    change.t_s.push_back(drive.t_s[k]);
    change.over_noise.push_back(
        kWheel_m / kNoise_mps *
        std::max(std::abs(left - drive.left_radps[k]), std::abs(right - drive.right_radps[k])));
  }
  return recording;
}

}  // namespace tera::blind
