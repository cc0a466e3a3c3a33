#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "core/units.h"
#include "dataset/export/export_job.h"
#include "dataset/export/gnss/nmea_sentences.h"
#include "dataset/export/record_views.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/recording.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {
namespace {

/// The two receivers of a machine, whose antennas together tell where it points.
///
/// Frames  W east, north, up; P the link that carries both, x forward, y left, z up.
/// Model   the horizontal direction of the measured baseline less that of the mounted one:
///         heading = 90 deg - (yaw of p_W,21 - yaw of p_P,21), clockwise from north.
/// Omits   roll and pitch of P, which turn the baseline's horizontal direction by a product of the
///         baseline's slope and the tilt.
class AntennaPair {
 public:
  /// The pair among a machine's receivers: there are exactly two of them, mounted on one link at
  /// known places that are not above one another. Else nothing.
  static std::optional<AntennaPair> Of(const Recording& recording,
                                       const std::vector<std::string>& receivers);

  /// Heading of P from a fix of each, of the same time, the first receiver's first.
  double Heading_rad(const GnssSample& first, const GnssSample& second) const;

 private:
  explicit AntennaPair(double mounted_yaw_rad) : mounted_yaw_rad_(mounted_yaw_rad) {}
  double mounted_yaw_rad_;
};

/// A shorter horizontal baseline tells no direction: receivers measure to some centimetres.
constexpr double kShortestBaseline_m = 0.2;

std::optional<AntennaPair> AntennaPair::Of(const Recording& recording,
                                           const std::vector<std::string>& receivers) {
  if (receivers.size() != 2) return std::nullopt;
  const SensorSheet first = ReadSensorSheet(recording.directory() / receivers[0]);
  const SensorSheet second = ReadSensorSheet(recording.directory() / receivers[1]);
  if (!first.X_PS || !second.X_PS || first.parent_link != second.parent_link) return std::nullopt;
  const Vec3 baseline_m = second.X_PS->translation() - first.X_PS->translation();
  if (baseline_m.head<2>().norm() < kShortestBaseline_m) return std::nullopt;
  return AntennaPair(std::atan2(baseline_m.y(), baseline_m.x()));
}

double AntennaPair::Heading_rad(const GnssSample& first, const GnssSample& second) const {
  const Vec3 baseline_m = second.enu_m - first.enu_m;
  const double measured_yaw_rad = std::atan2(baseline_m.y(), baseline_m.x());
  return 90 * kDeg - (measured_yaw_rad - mounted_yaw_rad_);
}

/// A receiver's file, and where it has one the receiver that it makes a pair with.
struct Receiver {
  std::unique_ptr<CheckedFile> file;
  std::optional<AntennaPair> pair;  ///< of the first of two
  std::size_t second = 0;
  GnssSample last;
  bool measured = false;
};

std::vector<Receiver> OpenReceivers(const ExportJob& job, const std::vector<std::string>& paths) {
  std::vector<Receiver> receivers(paths.size());
  std::map<std::string, std::vector<std::size_t>> of_machine;
  for (std::size_t r = 0; r < paths.size(); ++r) {
    const std::filesystem::path file = job.folder / (paths[r] + ".nmea");
    MakeFolder(file.parent_path());
    receivers[r].file = std::make_unique<CheckedFile>(file);
    of_machine[MachineOf(paths[r])].push_back(r);
  }
  for (const auto& [machine, own] : of_machine) {
    std::vector<std::string> names;
    for (const std::size_t r : own) names.push_back(paths[r]);
    receivers[own.front()].pair = AntennaPair::Of(job.recording, names);
    receivers[own.front()].second = own.back();
  }
  return receivers;
}

bool HasFixAt(const Receiver& receiver, TimeNs t_ns) {
  return receiver.measured && receiver.last.t_ns == t_ns && receiver.last.fix != GnssFix::kNone;
}

/// The heading, once both of a pair have measured at this time.
void AppendHeading(TimeNs t_ns, std::vector<Receiver>* receivers) {
  for (Receiver& first : *receivers) {
    if (!first.pair) continue;
    const Receiver& second = (*receivers)[first.second];
    if (!HasFixAt(first, t_ns) || !HasFixAt(second, t_ns)) continue;
    first.file->Append(Hdt(first.pair->Heading_rad(first.last, second.last)));
    first.measured = false;  // said once
  }
}

}  // namespace

/// MACHINE/RECEIVER.nmea with GGA, RMC and GST of each sample, GST where there is a fix; HDT in the
/// file of the first of a machine's two receivers.
void ExportNmea(ExportJob* job) {
  const std::vector<std::string> paths = job->recording.ChannelsOf(kGnssChannel);
  RequireAny(paths, *job, "GNSS receiver");
  RecordStream stream(job->recording, paths);
  std::vector<Receiver> receivers = OpenReceivers(*job, paths);
  for (Record record; job->Next(&stream, &record);) {
    Receiver& receiver = receivers[record.channel];
    receiver.last = GnssOf(stream, record);
    receiver.measured = true;
    const TimeNs utc_ns = job->Stamp(record.t_ns, kDefaultStart_ns);
    receiver.file->Append(Gga(utc_ns, receiver.last));
    receiver.file->Append(Rmc(utc_ns, receiver.last));
    if (receiver.last.fix != GnssFix::kNone) receiver.file->Append(Gst(utc_ns, receiver.last));
    AppendHeading(record.t_ns, &receivers);
  }
  for (const Receiver& receiver : receivers) receiver.file->Commit();
}

}  // namespace tera
