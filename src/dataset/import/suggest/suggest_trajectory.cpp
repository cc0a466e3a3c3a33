#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <vector>

#include "core/error.h"
#include "dataset/import/logs/foreign_log.h"
#include "dataset/import/logs/number_table.h"
#include "dataset/import/suggest/guess.h"
#include "dataset/import/suggest/suggest.h"
#include "dataset/import/table_text.h"

// Suggests a mapping for a text file of poses without column names.

namespace tera {
namespace {

/// The first lines of a pose file.
struct PoseLines {
  std::string remark;  ///< the last comment line before the first pose
  std::string first;   ///< the first pose as written
  std::vector<std::vector<double>> rows;
};

std::vector<double> NumbersOfLine(const std::string& line) {
  std::vector<double> numbers;
  for (const std::string_view field :
       FieldsOfRecord(line, line.find(',') == std::string::npos ? ' ' : ',')) {
    const auto value = WholeNumber(field);
    if (!value) return {};
    numbers.push_back(*value);
  }
  return numbers;
}

/// Returns nullopt if the lines have different numbers of fields.
std::optional<PoseLines> PoseLinesOf(const std::filesystem::path& file) {
  constexpr std::size_t kMostLines = 1000;
  PoseLines lines;
  std::ifstream stream(file);
  for (std::string line; lines.rows.size() < kMostLines && std::getline(stream, line);) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.starts_with('#') && lines.rows.empty()) lines.remark = line;
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<double> row = NumbersOfLine(line);
    const bool is_last = stream.eof();  // the last line may be truncated
    if (row.empty() || (!lines.rows.empty() && row.size() != lines.rows.front().size())) {
      if (is_last) break;
      return std::nullopt;
    }
    if (lines.rows.empty()) lines.first = line;
    lines.rows.push_back(row);
  }
  if (lines.rows.size() < 2) return std::nullopt;
  return lines;
}

bool AreUnitQuaternions(const PoseLines& lines) {
  constexpr double kSlack = 0.01;
  return std::all_of(lines.rows.begin(), lines.rows.end(), [](const std::vector<double>& v) {
    return std::abs(std::hypot(std::hypot(v[4], v[5]), std::hypot(v[6], v[7])) - 1) < kSlack;
  });
}

bool AreRotations(const PoseLines& lines) {
  constexpr double kSlack = 0.01;
  const auto is_unit = [](double a, double b, double c) {
    return std::abs(std::hypot(a, b, c) - 1) < kSlack;
  };
  return std::all_of(lines.rows.begin(), lines.rows.end(), [&](const std::vector<double>& v) {
    return is_unit(v[0], v[1], v[2]) && is_unit(v[4], v[5], v[6]) && is_unit(v[8], v[9], v[10]) &&
           is_unit(v[0], v[4], v[8]) && std::abs(v[0] * v[4] + v[1] * v[5] + v[2] * v[6]) < kSlack;
  });
}

std::string TrajectoryTop(const std::filesystem::path& log) {
  return fmt::format(
      "# A first mapping by 'tera import --suggest': look at what is marked as guessed.\n"
      "name: {}\nmachine: machine   # guessed: name the machine's folder\nfile: {}\n",
      PlainNameOf(log.stem().string()), YamlWord(log.string()));
}

/// The key `form`. The order in a comment decides, or else the notation of the two formats;
/// otherwise a placeholder that the import refuses.
std::string FormYaml(const PoseLines& lines, bool in_nanoseconds) {
  const auto place_of = [&](const char* tum, const char* euroc) {
    return std::min(lines.remark.find(tum), lines.remark.find(euroc));
  };
  const std::size_t qw = place_of("qw", "q_RS_w"), qx = place_of("qx", "q_RS_x");
  const bool by_commas = lines.first.find(',') != std::string::npos;
  const bool is_named = qw != std::string::npos && qx != std::string::npos;
  const bool w_first = is_named ? qw < qx : by_commas && in_nanoseconds;
  const bool w_last = is_named ? qx < qw : !by_commas && !in_nanoseconds;
  if (w_first && in_nanoseconds) return "form: euroc   # ns, x, y, z, qw, qx, qy, qz\n";
  if (w_last && !in_nanoseconds) return "form: tum   # s, x, y, z, qx, qy, qz, qw\n";
  return "form: tum_or_euroc   # fill in: tum (s, qx qy qz qw) or euroc (ns, qw qx qy qz)\n";
}

/// The KITTI times file of a pose file: times.txt next to it or in its sequence.
std::filesystem::path TimesBeside(const std::filesystem::path& log) {
  const std::filesystem::path folder = log.parent_path();
  std::error_code ignored;
  for (const std::filesystem::path& times :
       {folder / "times.txt", folder / "../sequences" / log.stem() / "times.txt"}) {
    if (std::filesystem::is_regular_file(times, ignored)) return times;
  }
  return {};
}

std::string KittiPosesYaml(const PoseLines& lines, const std::filesystem::path& times) {
  const auto span_m = [&](std::size_t column) {
    const auto [low, high] =
        std::minmax_element(lines.rows.begin(), lines.rows.end(),
                            [&](const auto& a, const auto& b) { return a[column] < b[column]; });
    return (*high)[column] - (*low)[column];
  };
  // Machines move on the ground, so the axis with little motion is vertical: y for a camera.
  constexpr double kFlat = 0.2;
  const double x_m = span_m(3), y_m = span_m(7), z_m = span_m(11);
  const bool is_camera = y_m < kFlat * std::max(x_m, z_m) && y_m < z_m;
  return "pose:\n  form: kitti   # three rows of rotation and place\n" +
         (times.empty()
              ? "  time: unknown   # to fill in, as {interval: 0.1, unit: s} of KITTI's 10 Hz: the "
                "file has no times\n"
              : fmt::format("  times: {}   # guessed: beside the poses, a line each\n",
                            YamlWord(times.string()))) +
         (is_camera
              ? "  world: {rpy_deg: [-90, 0, -90]}   # guessed: of a camera, whose y points down\n"
                "  body: {rpy_deg: [0, -90, 90]}   # guessed: forward, left and up in the camera\n"
              : "");
}

}  // namespace

std::optional<std::string> SuggestForTrajectory(const std::filesystem::path& log) {
  const auto lines = PoseLinesOf(log);
  if (!lines) return std::nullopt;
  const std::size_t width = lines->rows.front().size();
  if (width == 12 && AreRotations(*lines))
    return TrajectoryTop(log) + KittiPosesYaml(*lines, TimesBeside(log));
  const bool is_euroc_wide = width > 8 && lines->remark.find("q_RS_w") != std::string::npos;
  if ((width != 8 && !is_euroc_wide) || !AreUnitQuaternions(*lines)) return std::nullopt;
  for (std::size_t k = 1; k < lines->rows.size(); ++k) {
    if (lines->rows[k][0] <= lines->rows[k - 1][0]) return std::nullopt;
  }
  constexpr double kLeast_ns = 1e12;  // larger than seconds of any clock
  const bool in_nanoseconds = lines->rows.front()[0] > kLeast_ns;
  const double first_s = lines->rows.front()[0] * (in_nanoseconds ? 1e-9 : 1);
  return TrajectoryTop(log) + (first_s > kLeastEpoch_s ? "zero: start\n" : "") + "pose:\n  " +
         FormYaml(*lines, in_nanoseconds);
}

}  // namespace tera
