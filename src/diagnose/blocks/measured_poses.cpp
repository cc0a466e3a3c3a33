#include "diagnose/blocks/measured_poses.h"

#include <string>
#include <utility>
#include <vector>

#include "core/units.h"
#include "diagnose/blocks/candidate_list.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

Candidate OfPoses(std::string_view id, std::vector<FreeParameter> free,
                  std::vector<std::vector<double>> starts) {
  CandidateList out(std::string(kPoses), EffectTarget::kImu, {}, SensorMechanisms());
  out.Add(id, std::move(free), std::move(starts));
  return out.Take().front();
}

const Term* FindTerm(const Structure& terms, std::string_view id) {
  for (const Term& term : terms) {
    if (term.candidate->target == kPoses && term.candidate->mechanism->id == id) return &term;
  }
  return nullptr;
}

}  // namespace

std::span<const Mechanism> PoseMechanisms() {
  static const std::vector<Mechanism> mechanisms = {
      {"arrival_stamps", Slot::kSensorTiming, {}, {}}};
  return mechanisms;
}

Candidate PoseLatencyCandidate() {
  return OfPoses("latency", {{0, 0, 3}}, {{0.05, 0}, {0.15, 0}, {0.4, 0}});
}

Candidate ArrivalStampsCandidate() {
  return {&PoseMechanisms().front(), std::string(kPoses), {}, {{}}, {}};
}

bool HasArrivalStamps(const Structure& terms) {
  return FindTerm(terms, PoseMechanisms().front().id) != nullptr;
}

Candidate MapTiltCandidate() {
  return OfPoses("mount_rotation", {{0, -15, 15}, {1, -15, 15}},
                 {{0.5, 0, 0}, {0, 0.5, 0}, {2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}});
}

double PoseLatency_s(const Structure& terms) {
  const Term* late = FindTerm(terms, "latency");
  return late != nullptr ? late->values.front() : 0;
}

Mat3 MapTilt(const Structure& terms) {
  const Term* tilt = FindTerm(terms, "mount_rotation");
  if (tilt == nullptr) return Mat3::Identity();
  return RotationFromRpy(tilt->values[0] * kDeg, tilt->values[1] * kDeg, 0).transpose();
}

Structure WithoutPoseTerms(Structure terms) {
  std::erase_if(terms, [](const Term& term) { return term.candidate->target == kPoses; });
  return terms;
}

}  // namespace tera
