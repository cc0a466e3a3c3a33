#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "layout/evaluate.h"
#include "layout/measures/detection_probability.h"
#include "layout/measures/people.h"
#include "layout/measures/person_samples.h"
#include "layout/people_around.h"
#include "sim/run/recorded_run.h"
#include "sim/state/state_log.h"
#include "sim/state/state_playback.h"

// Probabilities of detection against a detector of people in generated datasets: do they rank
// layouts equally, and do they agree in value?

namespace tera {
namespace {

constexpr double kNear_m = 0.75;       ///< from a cluster's centroid to its person
constexpr std::size_t kEveryScan = 5;  ///< of ten a second
constexpr TimeNs kHalfScan_ns = 50'000'000;
constexpr int kMany = 50;  ///< points of a cluster, enough for some visible persons to fail

/// As in the test of elevation maps, each with a dense and with a sparse lidar.
const std::map<std::string, std::string> kPeopleRankingMounts = {
    {"roof", "xyz_m: [0.05, 0.35, 2.3], rpy_deg: [0, 10, 0]"},
    {"low", "xyz_m: [0.9, 0.5, 1.0], rpy_deg: [0, 0, 0]"},
    {"tilted", "xyz_m: [0.8, 0.5, 2.2], rpy_deg: [0, 32, 0]"}};
const std::vector<std::string> kLidars = {"os1_64", "vlp16"};

/// A person in one scan.
struct Tried {
  std::string person;
  int least = 0;        ///< points of a cluster
  double expected = 0;  ///< points on her
  double counted = 0;   ///< the same in the scan
  bool found = false;

  double Predicted() const { return ProbabilityOfAtLeast(least, expected); }
};

/// Prediction and outcome of a layout, with clusters of one least size.
struct Outcome {
  std::string layout;
  double figure = 0;  ///< of the evaluation: mean over the places around the machine
  std::vector<Tried> tried;
  std::size_t nobody = 0;  ///< clusters where no person is

  double Predicted() const {
    return std::accumulate(tried.begin(), tried.end(), 0.0,
                           [](double sum, const Tried& t) { return sum + t.Predicted(); }) /
           static_cast<double>(tried.size());
  }
  /// Points on all persons over the expected number.
  double Fill() const {
    double expected = 0, counted = 0;
    for (const Tried& t : tried) {
      expected += t.expected;
      counted += t.counted;
    }
    return counted / expected;
  }
  double Found() const {
    return static_cast<double>(
               std::count_if(tried.begin(), tried.end(), [](const Tried& t) { return t.found; })) /
           static_cast<double>(tried.size());
  }
  /// Error of the found share, for as many persons at random places.
  double Error() const { return ShareError(Found(), tried.size()); }
};

std::string TextOf(const Outcome& o) {
  std::string text = fmt::format(
      "{}: figure {:.3f}, predicted {:.3f}, found {:.3f} +- {:.3f}, points {:.2f} of the expected; "
      "by what is predicted",
      o.layout, o.figure, o.Predicted(), o.Found(), o.Error(), o.Fill());
  for (const auto& [low, high] : {std::pair{-1.0, 0.01}, {0.01, 0.5}, {0.5, 0.99}, {0.99, 2.0}}) {
    Outcome part;
    std::copy_if(o.tried.begin(), o.tried.end(), std::back_inserter(part.tried),
                 [&](const Tried& t) { return t.Predicted() > low && t.Predicted() <= high; });
    if (part.tried.empty()) continue;
    text +=
        fmt::format("; of {}: {:.3f}, {:.3f}", part.tried.size(), part.Predicted(), part.Found());
  }
  return text + fmt::format("; {} clusters of nobody", o.nobody);
}

/// Difference of found persons between two layouts, in standard errors. Both were tested on the
/// same persons; scans of a person are alike, so that each counts as one sample.
double FoundMoreInErrors(const Outcome& a, const Outcome& b) {
  std::map<std::string, double> more;
  for (std::size_t i = 0; i < a.tried.size(); ++i) {
    more[a.tried[i].person] += int{a.tried[i].found} - int{b.tried[i].found};
  }
  const auto n = static_cast<double>(more.size());
  double sum = 0, sum2 = 0;
  for (const auto& [person, value] : more) {
    sum += value;
    sum2 += value * value;
  }
  const double mean = sum / n, variance = (sum2 / n - mean * mean) * n / (n - 1);
  return variance > 0 ? mean / std::sqrt(variance / n) : 0;
}

/// The person faces the machine, as in the figures.
Pose FacingFrom(const Pose& X_HPerson) {
  const Vec3 p_H_m = X_HPerson.translation();
  return MakePose(p_H_m, 0, 0, std::atan2(p_H_m.y(), p_H_m.x()));
}

class PeopleRanking : public testing::Test {
 protected:
  PeopleRanking()
      : cycle_(site_.base(), {}),
        loaded_(LoadRecordedScenario(site_.base(), {}, {})),
        assembly_(loaded_.scenario),
        sighting_(loaded_.scenario, assembly_, 2) {
    study_.rate_hz = 1;
    study_.points = 200;
    study_.person.postures = {{"standing", Vec3(0.3, 0.5, 1.75)}};
    for (const std::string& lidar : kLidars) {
      for (const auto& [name, mount] : kPeopleRankingMounts) {
        site_.Resense(name + "_" + lidar, lidar, mount);
        layouts_.push_back(LoadLayout(site_.RigFile(name + "_" + lidar), cycle_, 0));
      }
    }
    const std::vector<LayoutReport> reports = Evaluate(cycle_, study_, layouts_, {.threads = 2});
    for (std::size_t l = 0; l < layouts_.size(); ++l) {
      Outcome outcome;
      outcome.layout = layouts_[l].name;
      for (const int least : {study_.person.cluster_points, kMany}) of_[least].push_back(outcome);
      of_[study_.person.cluster_points][l].figure =
          MeanOf(*FindFigure(reports[l], {Measure::kProbability, "standing"}));
      Try(l);
    }
  }

  /// All persons in every fifth scan of a layout.
  void Try(std::size_t l) {
    const Recording recording(site_.Data(layouts_[l].name));
    const std::vector<TimeNs> times_ns = recording.FrameTimes("excavator1/lidar");
    StatePlayback playback(loaded_.scenario, loaded_.resolved_yaml, site_.base() / kStateFile);
    for (std::size_t k = 0; k < times_ns.size(); k += kEveryScan) {
      const LidarScan scan = recording.LoadScan("excavator1/lidar", times_ns[k]);
      while (playback.state().t_ns < scan.t_ns + kHalfScan_ns && playback.Step()) {
      }
      TryScan(scan, playback, l);
    }
  }

  void TryScan(const LidarScan& scan, const StatePlayback& playback, std::size_t l) {
    const MachineState& machine = playback.state().machines[0];
    MoveViewers(machine, &layouts_[l]);
    const Viewer& viewer = layouts_[l].viewers.front();
    sighting_.Show(playback.state(), playback.ground());
    Pose X_WH = Levelled(machine.links[FindMachine(study_, loaded_.scenario).upper].X_WB);
    X_WH.translation().z() =
        playback.ground().HeightAt(X_WH.translation().x(), X_WH.translation().y());
    std::vector<Pose> X_WP;
    for (const auto& person : playback.state().obstacles) {
      X_WP.push_back(X_WH * FacingFrom(X_WH.inverse() * person.X_WB));
    }
    const std::vector<double> expected =
        SamplesOnPersons(patches_, X_WP, viewer, study_.seen.reflectance, sighting_);
    for (auto& [least, outcomes] : of_) {
      PeopleDetector detector;
      detector.least = static_cast<std::size_t>(least);
      const std::vector<Vec3> clusters_H_m = detector.Detect(scan, X_WH.inverse() * viewer.X_WS);
      std::vector<bool> is_somebody(clusters_H_m.size(), false);
      for (std::size_t p = 0; p < X_WP.size(); ++p) {
        const Vec2 at_H_m = (X_WH.inverse() * X_WP[p]).translation().head<2>();
        Tried tried{loaded_.scenario.obstacles[p].name, least,
                    PersonRange::kBodyOfBox * expected[p],
                    PointsOn(loaded_.scenario.obstacles[p].name, scan), false};
        for (std::size_t c = 0; c < clusters_H_m.size(); ++c) {
          if ((clusters_H_m[c].head<2>() - at_H_m).norm() > kNear_m) continue;
          tried.found = is_somebody[c] = true;
        }
        outcomes[l].tried.push_back(tried);
      }
      outcomes[l].nobody +=
          static_cast<std::size_t>(std::count(is_somebody.begin(), is_somebody.end(), false));
    }
  }

  double PointsOn(const std::string& person, const LidarScan& scan) const {
    return static_cast<double>(
        std::count_if(scan.points.begin(), scan.points.end(), [&](const LidarPoint& point) {
          return assembly_.model().instances[point.instance].name == person;
        }));
  }

  const PeopleAround site_;
  const Cycle cycle_;
  const LoadedScenario loaded_;
  const SceneAssembly assembly_;
  Sighting sighting_;
  LayoutStudy study_ = LoadStudy({});
  const std::vector<BodyPatch> patches_ = PatchesOf({"standing", Vec3(0.3, 0.5, 1.75)});
  std::vector<Layout> layouts_;
  std::map<int, std::vector<Outcome>> of_;  ///< of each least size of a cluster
};

TEST_F(PeopleRanking, IsThatOfADetectorInDatasets) {
  for (const auto& [least, outcomes] : of_) {
    fmt::print("clusters of {} points and more, {} persons in scans\n", least,
               outcomes.front().tried.size());
    for (const Outcome& outcome : outcomes) fmt::print("  {}\n", TextOf(outcome));
  }
  for (const Outcome& outcome : of_.at(study_.person.cluster_points)) {
    // Two standard errors of the share cover the randomness of the persons' places.
    EXPECT_NEAR(outcome.Predicted(), outcome.Found(), 2 * outcome.Error()) << outcome.layout;
  }
  for (const auto& [least, outcomes] : of_) {
    int decided = 0;
    for (const Outcome& a : outcomes) {
      for (const Outcome& b : outcomes) {
        if (FoundMoreInErrors(a, b) < 2) continue;
        ++decided;
        EXPECT_GT(a.Predicted(), b.Predicted()) << a.layout << " finds more than " << b.layout;
        if (least != study_.person.cluster_points) continue;
        EXPECT_GT(a.figure, b.figure) << a.layout << " finds more than " << b.layout;
      }
    }
    fmt::print("of 15 pairs {} are told apart by clusters of {}\n", decided, least);
    EXPECT_GE(decided, 5);
  }
}

}  // namespace
}  // namespace tera
