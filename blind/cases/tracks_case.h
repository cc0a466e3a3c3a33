#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "blind/cases/case_recording.h"
#include "blind/plant/concealed.h"
#include "blind/plant/measurement.h"
#include "blind/plant/tracked_base.h"

namespace tera::blind {

/// Faults of the reference pose.
struct PoseNoise {
  double position_m = 0.003, memory = 0.9;  ///< coloured
  double angle_rad = 0.001;
  double lost = 0.02;
};

/// A machine that drives: how its tracks are, how they are measured.
struct TracksCase {
  TrackForm form;
  std::vector<TrackForm> without;  ///< the same without each of what is hidden
  PlainTracks tracks;              ///< numbers off from those of the scenario
  EncoderNoise noise;
  PoseNoise pose_noise;
};

/// Names of effects of tracks that the tool is asked to name.
const std::vector<std::string>& NameableTrackEffects();

/// Adds one of them to the tracks' form. What the effect comes to in the parameters of its name is
/// known after the drive alone: TruthOfTracks.
Concealed HideInTracks(const std::string& name, Strength strength, const Stream& stream,
                       TrackForm* form);

/// Also sets the parameters of what is hidden, by least squares over the drive without noise.
CaseRecording RecordTracks(const TracksCase& tracks, double duration_s, std::uint64_t seed,
                           const std::string& name, std::vector<Concealed>* hidden);

}  // namespace tera::blind
