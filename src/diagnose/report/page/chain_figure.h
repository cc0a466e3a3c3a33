#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// A stage of the chain from a lever to a measurement, with its findings.
struct ChainStage {
  /// "boom: dead band".
  struct Entry {
    bool is_cause = true;  ///< else a possible cause, an unexplained error or missing input
    std::string text;

    bool operator==(const Entry&) const = default;
  };

  std::string_view title;
  std::vector<std::string> compared;  ///< joints, pumps and sensors whose data were compared
  std::vector<Entry> entries;
};

/// The stages lever, valve, pump, joint, ground and sensor, each with its findings.
///
/// Model   a cause stands at its mechanism's slot, and an indistinguishable rival is possible at
///         its own. An unexplained error stands where it was measured, since its origin is unknown.
///         A stage was compared if a judged block has candidates in it, or sensors were compared
///         with each other.
std::array<ChainStage, 6> ChainOf(const Diagnosis& diagnosis);

/// The chain as a row of boxes with their key; on a narrow screen in several rows.
std::string ChainFigure(const Diagnosis& diagnosis);

}  // namespace tera
