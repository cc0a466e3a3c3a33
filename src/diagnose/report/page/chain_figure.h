#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// A stage of the chain from a lever to a measurement, and what a diagnosis says of it.
struct ChainStage {
  enum class Mark { kCause, kPossibleCause, kUnexplained, kMissingInput };
  /// "boom: dead band".
  struct Entry {
    Mark mark = Mark::kCause;
    std::string text;

    bool operator==(const Entry&) const = default;
  };

  std::string_view title;
  std::vector<std::string> compared;  ///< joints, pumps and sensors of which it was looked at
  std::vector<Entry> entries;

  bool Has(Mark mark) const;
};

/// Lever, valve, pump, joint, ground, sensor, each with what is wrong in it.
///
/// Model   a cause is where its mechanism's slot is, and what is not told apart from it is possible
///         where that one's is. Error that nothing explains is where it was
///         measured: no one knows where it arises. A stage was compared where a block that was
///         judged has candidates in it, or sensors were held against each other.
std::array<ChainStage, 6> ChainOf(const Diagnosis& diagnosis);

/// The chain as one inline SVG with its key. Boxes stand in one row, two rows or three, as the
/// screen is wide.
std::string ChainFigure(const Diagnosis& diagnosis);

}  // namespace tera
