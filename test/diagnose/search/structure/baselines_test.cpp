#include "diagnose/search/structure/baselines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "diagnose/search/toy_block.h"

namespace tera {
namespace {

constexpr std::size_t kSamples = 4000;
constexpr double kNoise = 0.05;

/// A toy with a squared lever, or with a larger gain.
struct Simpler {
  Simpler(double square, double louder) {
    const std::vector<double> lever = ToyLever(kSamples, 21);
    std::vector<double> clean = ToyResponse(lever, square, 0, 0);
    for (double& y : clean) y *= 1 + louder;
    const ReplayBlock block = ToyBlock(lever, ToyMeasured(clean, kNoise, 21), {0, 2, 3});
    const Stream stream(21, "diagnose");
    as_it_is = RmseAsItIs(block, stream)[0];
    answers = BaselinesOf(block, 1, stream);
    for (const BaselineAnswer& answer : answers) {
      if (answer.method == "greedy BIC" && !answer.names.empty()) {
        first_name = answer.names.front().mechanism;
      }
    }
  }
  const BaselineAnswer& Of(const std::string& method) const {
    for (const BaselineAnswer& answer : answers) {
      if (answer.method == method) return answer;
    }
    throw std::runtime_error(method);
  }

  double as_it_is = 0;
  std::vector<BaselineAnswer> answers;
  std::string first_name;
};

TEST(Baselines, TakeAwayWhatTheirKindOfModelHolds) {
  const Simpler squared(0.4, 0);
  EXPECT_GT(squared.as_it_is, 2 * kNoise);
  for (const char* method : {"static map", "greedy BIC", "sparse regression", "black box"}) {
    EXPECT_NEAR(squared.Of(method).rmse_final[0], kNoise, 0.2 * kNoise) << method;
  }
  EXPECT_GT(squared.Of("tuned parameters").rmse_final[0], 1.5 * kNoise) << "no gain is a square";
  EXPECT_EQ(squared.first_name, "square");
  EXPECT_TRUE(squared.Of("sparse regression").found);
}

TEST(Baselines, TuningFollowsAGainThatNoCandidateHas) {
  const Simpler louder(0, 0.3);
  EXPECT_NEAR(louder.Of("tuned parameters").rmse_final[0], kNoise, 0.2 * kNoise);
  EXPECT_GT(louder.Of("greedy BIC").rmse_final[0], 1.2 * kNoise);
}

}  // namespace
}  // namespace tera
