#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "blind/cases/case_recording.h"
#include "blind/plant/concealed.h"
#include "blind/plant/measurement.h"
#include "blind/plant/tracked_base.h"

namespace tera::blind {

/// Errors of the reference pose.
struct PoseNoise {
  double position_m = 0.003, memory = 0.9;  ///< coloured
  double angle_rad = 0.001;
  double lost = 0.02;
};

/// A driving machine: its tracks and their measurement.
struct TracksCase {
  TrackForm form;
  std::vector<TrackForm> without;  ///< the form without each of the hidden effects
  PlainTracks tracks;              ///< its numbers differ from the scenario's
  EncoderNoise noise;
  PoseNoise pose_noise;
};

/// Names of track effects that the tool is to name.
const std::vector<std::string>& NameableTrackEffects();

/// Adds one of them to the tracks' form. Its parameters under that name follow only from the drive:
/// TruthOfTracks.
Concealed HideInTracks(const std::string& name, Strength strength, const Stream& stream,
                       TrackForm* form);

/// Also sets the parameters of the hidden effects, by least squares over the drive without noise.
CaseRecording RecordTracks(const TracksCase& tracks, double duration_s, std::uint64_t seed,
                           const std::string& name, std::vector<Concealed>* hidden);

}  // namespace tera::blind
