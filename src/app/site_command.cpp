#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/arguments/argument_checks.h"
#include "app/commands.h"
#include "core/error.h"
#include "core/units.h"
#include "dataset/files/whole_folder.h"
#include "survey/site/survey_site.h"
#include "survey/site/write_site.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

struct SiteArguments {
  fs::path survey, out;
  std::vector<double> origin;
  double cell_m = 0, steepest_deg = 45;
  SiteRequest request;
};

/// Scenario name from a file name. Characters other than letters, digits, _ and - become _.
std::string ScenarioName(const fs::path& file) {
  std::string name = file.stem().string();
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > 127 || (!std::isalnum(byte) && c != '-')) c = '_';
  }
  return name;
}

void Print(const SurveySite& site) {
  const SurveyTerrain& terrain = site.terrain;
  const auto share = [&](HeightSource source) {
    return 100 * static_cast<double>(terrain.CountOf(source)) /
           static_cast<double>(terrain.grid.size());
  };
  fmt::print("points: {} read, {} left out, {} outliers, {} of the ground\n", site.points,
             site.left_out, site.outliers, site.ground_points);
  fmt::print(
      "terrain: {} x {} cells of {} m; {:.1f} % measured, {:.1f} % filled, {:.1f} % under "
      "things, {:.1f} % beyond the survey\n",
      terrain.grid.nx, terrain.grid.ny, terrain.grid.cell_m, share(HeightSource::kMeasured),
      share(HeightSource::kFilled), share(HeightSource::kUnderThing),
      share(HeightSource::kBeyondSurvey));
  for (const std::string& warning : site.warnings) fmt::print("warning: {}\n", warning);
  fmt::print("map: {}\n", site.has_map ? site.map.name
                          : site.middle_m.isZero()
                              ? "none; the survey's own frame, about the site's origin"
                              : fmt::format("none; x {:.3f}, y {:.3f} m of the survey lie at the "
                                            "site's origin",
                                            site.middle_m.x(), site.middle_m.y()));
  if (!site.map.vertical.empty()) {
    fmt::print(
        "warning: heights are above '{}', and a scenario takes them as above the WGS 84 "
        "ellipsoid; set site.height_m for GNSS\n",
        site.map.vertical);
  }
  fmt::print("things: {}\n", site.things.size());
  for (const SurveyThing& thing : site.things) {
    fmt::print("  {:.2f} x {:.2f} m, {:.2f} m high, {} points\n", thing.footprint.length_m,
               thing.footprint.width_m, thing.top_m - thing.ground_m, thing.points);
  }
}

void RunSite(SiteArguments arguments) {
  RequireNoneStopped(arguments.out);
  RequireNothingAt(arguments.out);
  SiteRequest& request = arguments.request;
  if (arguments.cell_m > 0) request.cell_m = arguments.cell_m;
  request.steepest_rad = arguments.steepest_deg * kDeg;
  if (!arguments.origin.empty()) {
    request.origin = {arguments.origin[0], arguments.origin[1], arguments.origin[2]};
  }
  const SurveySite site = MakeSurveySite(arguments.survey, request);
  const char* needless = !arguments.origin.empty() ? "--origin"
                         : request.about_middle    ? "--local"
                                                   : nullptr;
  if (site.has_map && needless) {
    throw InputError(needless,
                     fmt::format("the survey is in '{}' and needs none; remove it", site.map.name));
  }
  WholeFolder folder(arguments.out);
  WriteSite(site, ScenarioName(arguments.survey), arguments.survey.filename().string(),
            folder.temporary());
  folder.Commit();
  Print(site);
  fmt::print("scenario: {}\n", (arguments.out / "site.yaml").string());
}

}  // namespace

void AddSiteCommand(CLI::App* app) {
  constexpr double kFinest_m = 0.01, kCoarsest_m = 10, kWidest_m = 50;
  auto arguments = std::make_shared<SiteArguments>();
  CLI::App* command = app->add_subcommand(
      "site", "Make a site from a survey: its terrain, and things on it as obstacles");
  command->add_option("SURVEY", arguments->survey, "Points (.pcd, .ply, .las) or elevations (.tif)")
      ->required();
  command->add_option("--out", arguments->out, "Folder of the site; new or empty")->required();
  command
      ->add_option(
          "--cell", arguments->cell_m,
          "Side of the terrain's cells in m; without it the finest size with enough points")
      ->check(NumberBetween(kFinest_m, kCoarsest_m, "metres"));
  command->add_option("--map", arguments->request.map,
                      "Reference system of the coordinates if the file names none: EPSG:n");
  command->add_flag("--local", arguments->request.about_middle,
                    "Centre coordinates without a reference system on their own middle");
  command
      ->add_option("--origin", arguments->origin,
                   "Latitude, longitude (deg) and height (m) of (0, 0, 0) of a survey without a "
                   "reference system, with --local of its middle at height 0")
      ->expected(3);
  command
      ->add_option("--largest-thing", arguments->request.largest_thing_m,
                   "Smaller side of the largest thing that stands on the ground, in m; 6")
      ->check(NumberBetween(1, kWidest_m, "metres"));
  command
      ->add_option("--steepest-ground", arguments->steepest_deg,
                   "Largest slope of ground in deg; 45")
      ->check(NumberBetween(5, 80, "degrees"));
  command
      ->add_option("--gap", arguments->request.gap_m,
                   "Least distance in m between two things; nearer points are one thing; 0.5")
      ->check(NumberBetween(0.05, kCoarsest_m, "metres"));
  command->callback([arguments] { RunSite(*arguments); });
}

}  // namespace tera
