#include "survey/align/registration_json.h"

#include <nlohmann/json.hpp>

#include "core/units.h"

namespace tera {
namespace {

using Json = nlohmann::ordered_json;

Json ListOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json RowsOf(const Mat6& matrix) {
  Json rows = Json::array();
  for (int i = 0; i < 6; ++i) {
    Json row = Json::array();
    for (int j = 0; j < 6; ++j) row.push_back(matrix(i, j));
    rows.push_back(row);
  }
  return rows;
}

Json PoseOf(const Pose& X_AB) {
  const Quat q(X_AB.linear());
  Json pose;
  pose["xyz_m"] = ListOf(X_AB.translation());
  pose["rpy_deg"] = ListOf(RpyFromRotation(X_AB.linear()) / kDeg);
  pose["quaternion_wxyz"] = {q.w(), q.x(), q.y(), q.z()};
  return pose;
}

/// Axes among x, y, z, roll, pitch and yaw that are undetermined at `at_A_m`.
Json NotObserved(const Registration& registration, const Vec3& at_A_m) {
  Json names = Json::array();
  const auto observed = registration.ObservedAt(at_A_m);
  for (std::size_t k = 0; k < observed.size(); ++k) {
    if (!observed[k]) names.push_back(kPoseAxes[k]);
  }
  return names;
}

}  // namespace

std::string RegistrationJson(const Registration& registration, const std::string& a,
                             const std::string& b) {
  Json json;
  json["A"] = a;
  json["B"] = b;
  json["status"] = NameOf(registration.status);
  json["overlap_of_A"] = registration.overlap_of_A;
  json["overlap_of_B"] = registration.overlap_of_B;
  json["partners"] = registration.partners;
  json["residual_m"] = registration.residual_m;
  json["steps"] = registration.steps;
  if (registration.status != RegistrationStatus::kNoOverlap) {
    json["X_AB"] = PoseOf(registration.X_AB);
    json["covariance"] = RowsOf(registration.covariance);
    json["not_observed"] = NotObserved(registration, registration.X_AB.translation());
    json["covariance_kind"] = "sandwich; x, y, z in m, rotation vector in rad, in A";
    json["centre_A_m"] = ListOf(registration.centre_A_m);
    json["centre_covariance"] = RowsOf(registration.centre_covariance);
    json["centre_not_observed"] = NotObserved(registration, registration.centre_A_m);
  }
  json["open_axes"] = registration.open_axes;
  json["open_motions"] = Json::array();
  for (const OpenMotion& motion : registration.open) {
    Json entry = {{"kind", motion.is_turn ? "turn" : "shift"},
                  {"along", ListOf(motion.along)},
                  {"translation", ListOf(motion.translation)},
                  {"rotation", ListOf(motion.rotation)}};
    if (motion.is_turn) entry["through_A_m"] = ListOf(motion.through_A_m);
    json["open_motions"].push_back(entry);
  }
  return json.dump(2) + "\n";
}

}  // namespace tera
