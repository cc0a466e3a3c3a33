#include "diagnose/sensors/gear_travel.h"

#include <utility>

#include "diagnose/motion/reduce_samples.h"

namespace tera {
namespace {

double ResolutionOf_rad(const DiagnosisInput& input, const NamedEncoders& named) {
  for (const SensorDescription& sensor : input.sensors) {
    if (named.channel != input.machine + "/" + sensor.name) continue;
    return std::get<EncoderModel>(sensor.model).resolution_rad;
  }
  return 0;
}

}  // namespace

std::vector<TravelWindow> GearTravel(const DiagnosisInput& input, const Measurements& measured,
                                     TimeNs zero_ns) {
  const auto& gears = input.model->ground_tools.gears;
  std::vector<GearTrack> tracks;
  for (const NamedEncoders& named : measured.encoders) {
    for (std::size_t i = 0; i < named.recording.axes.size(); ++i) {
      for (std::size_t g = 0; g < gears.size(); ++g) {
        if (gears[g].name != named.recording.axes[i].name) continue;
        GearTrack track{.resolution_rad = ResolutionOf_rad(input, named),
                        .radius_m = gears[g].ShoeRadius_m(),
                        .left_m = LeftOfRoot_m(*input.model, g)};
        for (const EncoderSample& sample : named.recording.samples) {
          track.angle_rad.t_s.push_back(ToSeconds(sample.t_ns - zero_ns));
          track.angle_rad.value.push_back(sample.q_rad[i]);
        }
        tracks.push_back(std::move(track));
      }
    }
  }
  return !gears.empty() && tracks.size() == gears.size() ? TravelOf(tracks)
                                                         : std::vector<TravelWindow>{};
}

}  // namespace tera
