#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/arguments/argument_checks.h"
#include "app/commands.h"
#include "core/error.h"
#include "core/units.h"
#include "dataset/files/checked_file.h"
#include "survey/align/registration.h"
#include "survey/align/registration_hints.h"
#include "survey/align/registration_json.h"
#include "survey/points/raster_steps.h"
#include "survey/points/read_survey.h"

namespace tera {
namespace {

// Exit statuses of registrations that give no complete pose.
constexpr int kNoOverlap = 3, kNotConverged = 4, kOpen = 5;

struct RegisterArguments {
  std::filesystem::path a, b, json;
  std::vector<double> start;
  RegistrationRequest request;
};

void PrintPose(const Registration& found) {
  const Vec3 rpy_deg = RpyFromRotation(found.X_AB.linear()) / kDeg;
  const Vec3 p_m = found.X_AB.translation();
  fmt::print("X_AB: x {:.4f} y {:.4f} z {:.4f} m, roll {:.4f} pitch {:.4f} yaw {:.4f} deg\n",
             p_m.x(), p_m.y(), p_m.z(), rpy_deg.x(), rpy_deg.y(), rpy_deg.z());
  Vec6 sigma = found.centre_covariance.diagonal().cwiseSqrt();
  sigma.tail<3>() /= kDeg;
  const auto observed = found.ObservedAt(found.centre_A_m);
  const auto one = [&](std::size_t k) {
    return observed[k] ? fmt::format("{:.4f}", sigma[static_cast<Eigen::Index>(k)])
                       : std::string("not observed");
  };
  fmt::print(
      "1 sigma: x {} y {} z {} m, about x {} y {} z {} deg, of B at ({:.2f}, {:.2f}, {:.2f}) in "
      "A\n",
      one(0), one(1), one(2), one(3), one(4), one(5), found.centre_A_m.x(), found.centre_A_m.y(),
      found.centre_A_m.z());
}

void PrintOpen(const Registration& found) {
  if (found.open.empty()) return;
  fmt::print("not observed by the geometry: {}\n",
             found.open_axes.empty() ? "a combination of axes"
                                     : fmt::format("{}", fmt::join(found.open_axes, ", ")));
  for (const OpenMotion& motion : found.open) {
    const Vec3 &along = motion.along, &at_m = motion.through_A_m;
    if (motion.is_turn) {
      fmt::print(
          "  a rotation about ({:.2f}, {:.2f}, {:.2f}) through ({:.2f}, {:.2f}, {:.2f}) in A\n",
          along.x(), along.y(), along.z(), at_m.x(), at_m.y(), at_m.z());
    } else {
      fmt::print("  a shift along ({:.2f}, {:.2f}, {:.2f})\n", along.x(), along.y(), along.z());
    }
  }
}

void RequireOneMap(const RegisterArguments& arguments, const Survey& a, const Survey& b) {
  if (!a.map || !b.map || a.map->wkt == b.map->wkt) return;
  throw InputError(
      arguments.b.string(),
      {FaultKind::kInconsistent, fmt::format("is in '{}', and {} in '{}'; reproject one of them",
                                             b.map->name, arguments.a.string(), a.map->name)});
}

std::vector<Vec3> PointsOf(const Survey& survey) {
  return survey.pixel_m ? WithoutSteps(survey.p_m, *survey.pixel_m) : survey.p_m;
}

void RunRegister(RegisterArguments arguments) {
  const Survey a = ReadSurvey(arguments.a), b = ReadSurvey(arguments.b);
  RequireOneMap(arguments, a, b);
  if (!arguments.start.empty()) {
    const std::vector<double>& s = arguments.start;
    arguments.request.X_AB_start =
        MakePose(Vec3(s[0], s[1], s[2]), s[3] * kDeg, s[4] * kDeg, s[5] * kDeg);
  }
  const std::vector<Vec3> a_m = PointsOf(a), b_m = PointsOf(b);
  const Registration found = Register(a_m, b_m, arguments.request);
  fmt::print("status: {}\n", NameOf(found.status));
  if (found.status != RegistrationStatus::kNoOverlap) PrintPose(found);
  fmt::print("overlap: {:.1f} % of A, {:.1f} % of B; {} partners, {:.4f} m apart (rms)\n",
             100 * found.overlap_of_A, 100 * found.overlap_of_B, found.partners, found.residual_m);
  PrintOpen(found);
  for (const std::string& hint : RegistrationHints(a_m, b_m, arguments.request, found)) {
    fmt::print("hint: {}\n", hint);
  }
  if (!arguments.json.empty()) {
    WriteWholeFile(arguments.json,
                   RegistrationJson(found, arguments.a.string(), arguments.b.string()));
  }
  switch (found.status) {
    case RegistrationStatus::kRegistered:
      return;
    case RegistrationStatus::kNoOverlap:
      throw CLI::RuntimeError(kNoOverlap);
    case RegistrationStatus::kNotConverged:
      throw CLI::RuntimeError(kNotConverged);
    case RegistrationStatus::kOpen:
      throw CLI::RuntimeError(kOpen);
  }
}

}  // namespace

void AddRegisterCommand(CLI::App* app) {
  constexpr int kPoseNumbers = 6;
  constexpr double kLeast_m = 0.001, kMost_m = 100;
  auto arguments = std::make_shared<RegisterArguments>();
  CLI::App* command = app->add_subcommand(
      "register",
      "Align two scans, or a scan and a terrain: pose of B in A with its uncertainty; exit status "
      "3 without overlap, 4 without convergence, 5 with an unobserved direction");
  command->add_option("A", arguments->a, "Points (.pcd, .ply, .las) or elevations (.tif)")
      ->required();
  command->add_option("B", arguments->b, "Points or elevations; X_AB is their pose in A")
      ->required();
  command
      ->add_option("--start", arguments->start,
                   "X Y Z ROLL PITCH YAW (m, deg): initial X_AB; without it all 0")
      ->expected(kPoseNumbers);
  command
      ->add_option("--gate", arguments->request.gate_m,
                   "Largest distance in m of a point from its partner at the start; 1")
      ->check(NumberBetween(kLeast_m, kMost_m, "metres"));
  command
      ->add_option("--voxel", arguments->request.voxel_m,
                   "Edge in m of the cubes that keep one point each; 0.1")
      ->check(NumberBetween(kLeast_m, kMost_m, "metres"));
  command
      ->add_option("--least-overlap", arguments->request.least_overlap,
                   "Least share of points with partners in the other; 0.2")
      ->check(NumberBetween(0, 1, "of all"));
  command->add_option("--json", arguments->json, "File to write, see docs/reference/survey.md");
  command->callback([arguments] { RunRegister(*arguments); });
}

}  // namespace tera
