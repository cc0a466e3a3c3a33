#pragma once

#include <cstdint>
#include <vector>

#include "core/config/config.h"
#include "core/random.h"
#include "sim/operators/operator.h"

namespace tera {

/// Parameters of random lever motions.
struct RandomLeversPlan {
  double shortest_s = 0.5, longest_s = 3;  ///< range of the time for which a lever holds a position
  double amplitude = 1;
};

/// Moves all levers at random, to excite all motions of a machine.
///
/// Model   the lever of a joint holds each position for a uniform random time. The position is
///         neutral with probability 1/4, else uniform in +- amplitude.
///         The levers of all running gears change at the same times. After each position they take
///         the opposite one for as long, so that the machine returns to about its start.
class RandomLevers : public Operator {
 public:
  RandomLevers(const RandomLeversPlan& plan, const MachineModel& model,
               const OperatorStream& stream);
  std::vector<double> Levers(const OperatorView& view) override;

 private:
  /// The current position interval of one lever, or of all gear levers.
  struct Piece {
    std::int64_t index = -1;
    TimeNs until_ns = 0;
  };
  /// A random number in (0, 1) for interval `piece` of a lever.
  double Draw(std::int64_t piece, std::size_t lever, std::uint32_t which) const;
  double Position(std::int64_t piece, std::size_t lever) const;
  /// Begins the next interval if the current one is over; then returns true.
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
