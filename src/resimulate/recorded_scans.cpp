#include "resimulate/recorded_scans.h"

#include <fmt/format.h>

#include "core/check.h"
#include "resimulate/picture_caster.h"

namespace tera {
namespace {

constexpr std::size_t kMostPointsOfScan = 4000;  ///< points kept of a scan or depth image

/// An image or a scan.
Measurement LoadMeasurement(const Recording& recording, const std::string& channel,
                            ChannelForm form, TimeNs t_ns) {
  TERA_CHECK(form != ChannelForm::kRows, channel);
  if (form == ChannelForm::kPictures) return recording.LoadFrame(channel, t_ns);
  return recording.LoadScan(channel, t_ns);
}

}  // namespace

LoadedScan LoadRangeScan(const Recording& recording, const std::string& channel,
                         const SensorDescription& sensor, TimeNs t_ns) {
  const std::optional<Ranging> ranging = RangingOf(sensor);
  TERA_CHECK(ranging, channel);
  return ranging->points(sensor, LoadMeasurement(recording, channel, KindOf(sensor).form, t_ns),
                         kMostPointsOfScan);
}

LoadedPicture LoadGreyPicture(const Recording& recording, const std::string& channel,
                              const SensorDescription& sensor, TimeNs t_ns, int reduced) {
  const CameraIntrinsics& lens = PicturesOf(sensor)->intrinsics;
  const Image<std::uint8_t> rgb = recording.LoadFrame(channel, t_ns).rgb;
  if (rgb.empty()) return {{}, "it recorded no colours"};
  if (rgb.width_px != lens.width_px || rgb.height_px != lens.height_px) {
    return {
        {},
        fmt::format("its picture {} is of {} x {} pixels, but the scenario's camera has {} x {}; "
                    "need the camera that was recorded",
                    t_ns, rgb.width_px, rgb.height_px, lens.width_px, lens.height_px)};
  }
  return {ReducedGrey(rgb, reduced), ""};
}

}  // namespace tera
