#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/types/terrain_surface.h"
#include "dataset/files/block_file.h"
#include "sim/state/terrain_changes.h"

namespace tera {

/// What is packed of changes, each a stream of its own.
enum class TerrainStream {
  kCounts,    ///< of each step: refined tiles, vertices, grains
  kTiles,     ///< refined
  kPlaces,    ///< of vertices, from one to the next
  kCovers,    ///< of vertices, what differs
  kNumbers,   ///< of grains, beside those of the step before
  kNewborn,   ///< radius, soil and moisture of grains not seen before
  kHeights0,  ///< of vertices, beside the height before, by weight
  kHeights1,
  kHeights2,
  kHeights3,
  kPoints0,  ///< of grains, beside the place that their flight predicts, by weight
  kPoints1,
  kPoints2,
  kPoints3,
  kCount
};

/// The flight of each grain so far, by which the next place is predicted.
///
/// Model   a parabola through the last three places, of all that carry a grain's number.
class GrainFlights {
 public:
  struct Flight {
    TerrainSurface::Grain last;
    std::array<std::array<std::int64_t, 3>, 3> past = {};  ///< of each axis, the newest first
    int known = 0;
  };
  /// That of a grain of this number, which may be new.
  Flight& Of(std::uint16_t number) { return flights_[number]; }
  /// Ordered bits of the place of a flight's next grain along an axis.
  static std::int64_t Predict(const Flight& flight, int axis);
  static void Remember(const TerrainSurface::Grain& grain, Flight* flight);

 private:
  std::map<std::uint16_t, Flight> flights_;
};

/// Changes of the ground, step by step, packed without loss.
class TerrainPacker {
 public:
  /// Adds one change, found against `known` before it.
  void Add(const TerrainChange& change, const TerrainSurface& known);
  /// Adds the streams of all changes since the last call.
  void Take(Block* block);

 private:
  std::string& Of(TerrainStream stream) { return streams_[static_cast<std::size_t>(stream)]; }

  std::array<std::string, static_cast<std::size_t>(TerrainStream::kCount)> streams_;
  GrainFlights flights_;
  std::vector<std::uint16_t> numbers_;  ///< of the grains of the step before
};

/// Gives packed changes again.
class TerrainUnpacker {
 public:
  static constexpr std::size_t kStreams = static_cast<std::size_t>(TerrainStream::kCount);

  /// Takes the streams of a block from `*stream` on, which is moved behind them. False where they
  /// are not there.
  bool Load(Block* block, std::size_t* stream);
  /// The next change of a ground that is `known` before it. False where the streams hold none, or
  /// none of that ground.
  bool Next(const TerrainSurface& known, TerrainChange* change);

 private:
  struct Cursor {
    std::string bytes;
    std::size_t at = 0;
  };
  bool Byte(TerrainStream stream, std::uint8_t* value);
  bool Number(TerrainStream stream, std::uint64_t* value);
  bool Rest32(TerrainStream lowest, std::int64_t* value);
  bool NextVertex(const TerrainSurface& known, std::int64_t* place, TerrainChange* change);
  bool NextGrain(std::size_t index, TerrainChange* change);

  std::array<Cursor, kStreams> streams_;
  GrainFlights flights_;
  std::vector<std::uint16_t> numbers_;
};

}  // namespace tera
