#pragma once

#include <cstdint>
#include <vector>

#include "core/config/config.h"
#include "core/random.h"
#include "sim/operators/operator.h"

namespace tera {

/// How fast and how far levers are moved at random.
struct RandomLeversPlan {
  double shortest_s = 0.5, longest_s = 3;  ///< for which a lever stays where it is
  double amplitude = 1;
};

/// Moves every lever at random, to excite all that a machine can do.
///
/// Model   Each joint's lever stays where it is for a time, uniform between two bounds, then jumps
///         to a position that is neutral in one of four cases, else uniform in +- amplitude. Levers
///         of running gears change together, and every piece is followed by its opposite, so that a
///         machine comes back about as far as it went.
class RandomLevers : public Operator {
 public:
  RandomLevers(const RandomLeversPlan& plan, const MachineModel& model,
               const OperatorStream& stream);
  std::vector<double> Levers(const OperatorView& view) override;

 private:
  /// What one lever, or all of the gears', does at present.
  struct Piece {
    std::int64_t index = -1;
    TimeNs until_ns = 0;
  };
  /// A draw, in (0, 1), of one piece of a lever.
  double Draw(std::int64_t piece, std::size_t lever, std::uint32_t which) const;
  double Position(std::int64_t piece, std::size_t lever) const;
  /// Begins the next piece if the present one is over. True where it did.
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
