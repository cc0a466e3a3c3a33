#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tera::blind {

struct Estimate {
  double value = 0, sigma = 0;
};

/// One finding of a diagnosis.json, in the order of its weight.
struct Finding {
  std::string channel, mechanism, target;  ///< "unexplained" with no target
  std::vector<std::string> names;          ///< the class, itself included
  double confidence = 0;
  std::map<std::string, Estimate> parameters;
  std::string variable;  ///< empty: none
  std::vector<std::pair<double, double>> intervals_s;
  bool unexplained() const { return mechanism == "unexplained"; }
};

/// The tool's answer.
struct Answer {
  std::vector<std::string> verdicts;
  std::vector<Finding> findings;
  std::vector<std::pair<std::string, std::string>> untestable;  ///< mechanism, target
  std::map<std::string, double> rmse_after;  ///< by channel, on held-out manoeuvres
};

/// Throws InputError for a file that violates the form in docs/reference/diagnose.md.
Answer ReadAnswer(const std::filesystem::path& diagnosis_json);

}  // namespace tera::blind
