#include "survey/align/registration_hints.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace tera {
namespace {

/// A unit of length that a file may use instead of metres.
struct LengthUnit {
  const char* name;
  double m;
};
constexpr std::array kUnits = {LengthUnit{"millimetres", 0.001}, LengthUnit{"centimetres", 0.01},
                               LengthUnit{"feet", 0.3048}};

std::vector<Vec3> Scaled(std::vector<Vec3> p_m, double by) {
  for (Vec3& p : p_m) p *= by;
  return p_m;
}

struct Box {
  Vec3 low_m, high_m;
};

Box BoxOf(const std::vector<Vec3>& p_m, const Pose& X) {
  Box box{X * p_m.front(), X * p_m.front()};
  for (const Vec3& p : p_m) {
    box.low_m = box.low_m.cwiseMin(X * p);
    box.high_m = box.high_m.cwiseMax(X * p);
  }
  return box;
}

double SizeOf(const std::vector<Vec3>& p_m) {
  const Box box = BoxOf(p_m, Pose::Identity());
  return (box.high_m - box.low_m).norm();
}

/// Sum of both overlaps; 0 for a fit that means nothing. A floor fits any floor of similar size, so
/// an open result counts only at a very different scale.
double FitOf(const Registration& found, double scale) {
  constexpr double kLeastOverlap = 0.5, kFarOff = 0.1;
  const bool is_told = found.status == RegistrationStatus::kRegistered ||
                       (found.status == RegistrationStatus::kOpen && scale < kFarOff);
  const double more = std::max(found.overlap_of_A, found.overlap_of_B);
  return is_told && more > kLeastOverlap ? found.overlap_of_A + found.overlap_of_B : 0;
}

/// Unit with which cloud "A" or "B" fits the other best.
struct UnitFit {
  const char* cloud = "";
  LengthUnit unit{};
  double overlap = 0;
};

std::optional<UnitFit> FindUnit(const std::vector<Vec3>& a_m, const std::vector<Vec3>& b_m,
                                const RegistrationRequest& request, const Registration& found) {
  constexpr double kMostRatio = 20;  // largest ratio of the sizes of a scan and its survey
  const double a_size_m = SizeOf(a_m), b_size_m = SizeOf(b_m);
  const auto are_alike = [](double one_m, double other_m) {
    return one_m < kMostRatio * other_m && other_m < kMostRatio * one_m;
  };
  UnitFit best{.overlap = found.overlap_of_A + found.overlap_of_B};
  const auto consider = [&](const char* cloud, const LengthUnit& unit, const Registration& fit) {
    const double overlap = FitOf(fit, unit.m);
    if (overlap > best.overlap) best = {cloud, unit, overlap};
  };
  for (const LengthUnit& unit : kUnits) {
    RegistrationRequest scaled = request;
    if (are_alike(a_size_m, unit.m * b_size_m)) {
      consider("B", unit, Register(a_m, Scaled(b_m, unit.m), scaled));
    }
    scaled.X_AB_start.translation() *= unit.m;
    if (are_alike(unit.m * a_size_m, b_size_m)) {
      consider("A", unit, Register(Scaled(a_m, unit.m), b_m, scaled));
    }
  }
  return *best.cloud == 0 ? std::nullopt : std::optional(best);
}

void HintAtMaps(const std::vector<Vec3>& a_m, const std::vector<Vec3>& b_m, const Pose& X_AB_start,
                std::vector<std::string>* hints) {
  constexpr double kOfMaps_m = 10e3;
  const Box a = BoxOf(a_m, Pose::Identity()), b = BoxOf(b_m, X_AB_start);
  const Vec3 gap_m = (a.low_m - b.high_m).cwiseMax(b.low_m - a.high_m).cwiseMax(0.0);
  if (gap_m.norm() < kOfMaps_m) return;
  const Vec3 middle_m = 0.5 * (a.low_m + a.high_m);
  hints->push_back(
      fmt::format("B lies {:.0f} km from A at the start: map coordinates in one, site coordinates "
                  "in the other? give B's pose in A with --start X Y Z ROLL PITCH YAW; the middle "
                  "of A is ({:.1f}, {:.1f}, {:.1f})",
                  gap_m.norm() / 1000, middle_m.x(), middle_m.y(), middle_m.z()));
}

}  // namespace

std::vector<std::string> RegistrationHints(const std::vector<Vec3>& a_m,
                                           const std::vector<Vec3>& b_m,
                                           const RegistrationRequest& request,
                                           const Registration& found) {
  // An open result with a high overlap is a floor on a floor, so the clouds are not far apart.
  constexpr double kMostOfFloor = 0.9;
  std::vector<std::string> hints;
  const bool is_placed = found.status == RegistrationStatus::kRegistered ||
                         (found.status == RegistrationStatus::kOpen &&
                          std::min(found.overlap_of_A, found.overlap_of_B) > kMostOfFloor);
  if (is_placed || a_m.empty() || b_m.empty()) return hints;
  if (const auto fit = FindUnit(a_m, b_m, request, found)) {
    hints.push_back(fmt::format("{} fits where its numbers are {}: scale them by {:g}", fit->cloud,
                                fit->unit.name, fit->unit.m));
  }
  if (found.status == RegistrationStatus::kNoOverlap) {
    HintAtMaps(a_m, b_m, request.X_AB_start, &hints);
  }
  return hints;
}

}  // namespace tera
