#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "dataset/export/export_job.h"
#include "dataset/export/record_views.h"
#include "dataset/export/stamp_text.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/dataset_description.h"

namespace tera {
namespace {

/// RTKLIB's number for a fix quality.
int QualityOf(GnssFix fix) {
  switch (fix) {
    case GnssFix::kRtkFixed:
      return 1;
    case GnssFix::kRtkFloat:
      return 2;
    case GnssFix::kDifferential:
      return 4;
    case GnssFix::kSingle:
    case GnssFix::kNone:
      return 5;
  }
  return 5;
}

std::string Header() {
  return fmt::format(
      "% program   : TERA {}\n"
      "%\n"
      "% (lat/lon/height=WGS84/ellipsoidal,Q=1:fix,2:float,3:sbas,4:dgps,5:single,6:ppp,"
      "ns=# of satellites)\n"
      "%  UTC                  latitude(deg) longitude(deg)  height(m)   Q  ns   sdn(m)   sde(m)  "
      " sdu(m)  sdne(m)  sdeu(m)  sdun(m) age(s)  ratio\n",
      TeraVersion());
}

std::string Line(TimeNs utc_ns, const GnssSample& s) {
  constexpr int kDecimals = 3;
  constexpr TimeNs kNsPerMillisecond = 1'000'000;
  const CivilTime t = CivilTimeOf(RoundedTo(utc_ns, kDecimals));
  const Vec3 sigma_m = s.variance_enu_m2.cwiseSqrt();
  return fmt::format(
      "{:04}/{:02}/{:02} {:02}:{:02}:{:02}.{:03} {:14.9f} {:14.9f} {:10.4f} {:3} {:3} {:8.4f} "
      "{:8.4f} {:8.4f} {:8.4f} {:8.4f} {:8.4f} {:6.2f} {:6.1f}\n",
      t.year, t.month, t.day, t.hour, t.minute, t.second, t.nanosecond / kNsPerMillisecond,
      s.lat_deg, s.lon_deg, s.alt_m, QualityOf(s.fix), /*satellites=*/0, sigma_m.y(), sigma_m.x(),
      sigma_m.z(), 0.0, 0.0, 0.0, /*age=*/0.0, /*ratio=*/0.0);
}

}  // namespace

/// Writes MACHINE/RECEIVER.pos with one line per sample that has a fix. Covariances, satellites,
/// age and ratio are not recorded; they are 0, which means unknown in RTKLIB.
///
/// Source  RTKLIB 2.4.2 manual, appendix B.1, "Positioning solution file".
void ExportPos(ExportJob* job) {
  const std::vector<std::string> paths = job->recording.ChannelsOf(kGnssChannel);
  RequireAny(paths, *job, "GNSS receiver");
  RecordStream stream(job->recording, paths);
  std::vector<std::unique_ptr<CheckedFile>> files;
  for (const std::string& path : paths) {
    const std::filesystem::path file = job->folder / (path + ".pos");
    MakeFolder(file.parent_path());
    files.push_back(std::make_unique<CheckedFile>(file));
    files.back()->Append(Header());
  }
  for (Record record; job->Next(&stream, &record);) {
    const GnssSample sample = GnssOf(stream, record);
    if (sample.fix == GnssFix::kNone) continue;
    files[record.channel]->Append(Line(job->Stamp(record.t_ns, kDefaultStart_ns), sample));
  }
  for (const auto& file : files) file->Commit();
}

}  // namespace tera
