#include <fmt/format.h>

#include <array>
#include <charconv>

#include "core/error.h"
#include "core/motion.h"
#include "dataset/import/logs/foreign_log.h"
#include "dataset/import/logs/log_time.h"
#include "dataset/import/logs/number_table.h"
#include "dataset/import/table_text.h"

namespace tera {
namespace {

constexpr std::array<const char*, 7> kPoseColumns = {"x", "y", "z", "qw", "qx", "qy", "qz"};
constexpr std::size_t kKittiNumbers = 12;

using Numbers = std::vector<double>;
using PoseNumbers = std::array<double, 7>;  ///< in the order of kPoseColumns

/// Exact for plain digits; double precision otherwise.
std::optional<TimeNs> PoseTimeOf(std::string_view text, bool in_nanoseconds) {
  const auto number = WholeNumber(text);
  if (!in_nanoseconds) {
    if (const auto exact = SecondsOfText(text)) return exact;
    return number ? std::optional(FromSeconds(*number)) : std::nullopt;
  }
  TimeNs t_ns = 0;
  const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), t_ns);
  if (status == std::errc() && stop == text.data() + text.size()) return t_ns;
  constexpr double kLatest_ns = 9e18;
  if (!number || std::abs(*number) > kLatest_ns) return std::nullopt;
  return static_cast<TimeNs>(*number);
}

/// Pose from the three rows of rotation and position; nullopt if the rotation is invalid.
std::optional<PoseNumbers> PoseOfRows(const Numbers& v) {
  constexpr double kSlack = 0.05;
  Mat3 R;
  R << v[0], v[1], v[2], v[4], v[5], v[6], v[8], v[9], v[10];
  if (!(R * R.transpose()).isIdentity(kSlack) || R.determinant() < 0) return std::nullopt;
  const Quat q = Quat(R).normalized();
  return PoseNumbers{v[3], v[7], v[11], q.w(), q.x(), q.y(), q.z()};
}

class TrajectoryReader {
 public:
  TrajectoryReader(const std::filesystem::path& file, const std::string& type,
                   LeftOutRows* left_out)
      : lines_(file), type_(type), left_out_(left_out) {}

  void ReadTimes(const std::filesystem::path& file) {
    LogLines lines(file);
    for (std::string line; lines.Next(&line);) {
      if (line.empty()) continue;
      const auto t_ns = PoseTimeOf(TrimmedText(line), /*in_nanoseconds=*/false);
      if (!t_ns) lines.Fault(fmt::format("'{}' is no time in s", line), nullptr);
      times_.push_back(*t_ns);
    }
  }

  std::unique_ptr<const RowTable> Read() {
    auto table = std::make_unique<NumberTable>(
        lines_.file(), std::vector<std::string>(kPoseColumns.begin(), kPoseColumns.end()));
    for (std::string line; lines_.Next(&line);) {
      const std::vector<std::string_view> fields =
          FieldsOfRecord(line, line.find(',') == std::string::npos ? ' ' : ',');
      if (fields.empty() || fields.front().empty() || fields.front().starts_with('#')) continue;
      if (lines_.number() == 1 && !WholeNumber(fields.front())) continue;  // column names
      TimeNs t_ns = pose_ < times_.size() ? times_[pose_] : 0;
      ++pose_;
      if (const auto pose = PoseOf(fields, &t_ns)) {
        std::vector<NumberTable::Cell> cells;
        for (std::size_t k = 0; k < kPoseColumns.size(); ++k) {
          cells.push_back({kPoseColumns[k], (*pose)[k]});
        }
        table->AddRow(lines_.number(), t_ns, cells);
      }
    }
    if (!times_.empty() && times_.size() != pose_) {
      throw InputError(
          lines_.file().string(),
          {FaultKind::kInconsistent,
           fmt::format("has {} poses but {} times; need the same number", pose_, times_.size())});
    }
    return table;
  }

 private:
  /// Parses the pose in a line. Reports a fault and returns nullopt if there is none.
  std::optional<PoseNumbers> PoseOf(const std::vector<std::string_view>& fields, TimeNs* t_ns) {
    const bool is_kitti = type_ == kKittiPosesType;
    constexpr std::size_t kTimedFields = 8;
    const std::size_t need = is_kitti ? kKittiNumbers : kTimedFields;
    if (fields.size() < need || (is_kitti && fields.size() > need)) {
      lines_.Fault(fmt::format("found {} fields, need {}", fields.size(), need), left_out_);
      return std::nullopt;
    }
    Numbers v;
    for (std::size_t k = is_kitti ? 0 : 1; k < need; ++k) {
      const auto value = WholeNumber(fields[k]);
      if (!value) {
        lines_.Fault(fmt::format("'{}' is no number", fields[k]), left_out_);
        return std::nullopt;
      }
      v.push_back(*value);
    }
    if (is_kitti) {
      const auto pose = PoseOfRows(v);
      if (!pose) lines_.Fault("its numbers are not a rotation and a position", left_out_);
      return pose;
    }
    const auto time_ns = PoseTimeOf(fields[0], type_ == kEurocPosesType);
    if (!time_ns) {
      lines_.Fault(fmt::format("'{}' is no time", fields[0]), left_out_);
      return std::nullopt;
    }
    *t_ns = *time_ns;
    if (type_ == kEurocPosesType) return PoseNumbers{v[0], v[1], v[2], v[3], v[4], v[5], v[6]};
    return PoseNumbers{v[0], v[1], v[2], v[6], v[3], v[4], v[5]};
  }

  LogLines lines_;
  std::vector<TimeNs> times_;  ///< times from a separate file, if there is one
  std::size_t pose_ = 0;
  const std::string& type_;
  LeftOutRows* left_out_;
};

}  // namespace

std::string TypeOfTrajectory(std::string_view form) {
  return form == "tum" ? kTumPosesType : form == "euroc" ? kEurocPosesType : kKittiPosesType;
}

std::unique_ptr<const RowTable> ReadTrajectoryLog(const std::filesystem::path& file,
                                                  const std::string& type, LeftOutRows* left_out,
                                                  const std::filesystem::path& times) {
  TrajectoryReader reader(file, type, left_out);
  if (!times.empty()) reader.ReadTimes(times);
  return reader.Read();
}

}  // namespace tera
