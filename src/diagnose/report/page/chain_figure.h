#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// A stage of the chain from lever to measurement, with its findings.
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

/// The stages lever, valve, pump, joint, ground and sensor, with their findings.
///
/// Model   A slot is a place of mechanisms in the chain (core/types/effects.h). A cause belongs to
///         the stage of its mechanism's slot. A rival is a possible cause at the stage of its own
///         slot. An unexplained error belongs to the stage where it was measured, because its
///         origin is unknown. A stage counts as compared if a judged block has candidates there, or
///         if sensors there were compared with each other.
std::array<ChainStage, 6> ChainOf(const Diagnosis& diagnosis);

/// The chain as a row of boxes with a legend. Narrow screens show several rows.
std::string ChainFigure(const Diagnosis& diagnosis);

}  // namespace tera
