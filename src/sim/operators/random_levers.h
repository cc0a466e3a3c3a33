#pragma once

#include <cstdint>
#include <vector>

#include "core/config/config.h"
#include "core/random.h"
#include "sim/operators/operator.h"

namespace tera {

/// Speed and size of random lever moves.
struct RandomLeversPlan {
  double shortest_s = 0.5, longest_s = 3;  ///< duration of a lever position
  double amplitude = 1;
};

/// Moves every lever at random, to excite all motions of a machine.
///
/// Model   Each joint's lever holds a position for a uniform random time between two bounds. The
///         next position is neutral with probability one quarter, else uniform in +- amplitude.
///         Levers of running gears change together, and each piece is followed by its opposite, so
///         the machine returns to about its start.
class RandomLevers : public Operator {
 public:
  RandomLevers(const RandomLeversPlan& plan, const MachineModel& model,
               const OperatorStream& stream);
  std::vector<double> Levers(const OperatorView& view) override;

 private:
  /// The current piece of one lever, or of all gear levers.
  struct Piece {
    std::int64_t index = -1;
    TimeNs until_ns = 0;
  };
  /// A random number in (0, 1) for a piece of a lever.
  double Draw(std::int64_t piece, std::size_t lever, std::uint32_t which) const;
  double Position(std::int64_t piece, std::size_t lever) const;
  /// Begins the next piece if the current one is over, and returns true if it did.
  bool Advance(TimeNs t_ns, std::size_t lever, bool and_back, Piece* piece) const;

  RandomLeversPlan plan_;
  Stream stream_;
  std::vector<Piece> pieces_;  ///< one for each lever
  Piece gears_;
  std::vector<double> levers_;
};

/// Reads the keys of `type: random_levers`.
RandomLeversPlan ReadRandomLevers(const ConfigMap& config);

}  // namespace tera
