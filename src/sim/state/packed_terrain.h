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

/// Streams of packed ground changes.
enum class TerrainStream {
  kCounts,    ///< per step: number of refined tiles, vertices and clods
  kTiles,     ///< refined tiles
  kPlaces,    ///< index difference between consecutive changed vertices
  kCovers,    ///< changed bits of vertex covers
  kNumbers,   ///< clod numbers, relative to the previous step
  kNewborn,   ///< radius, soil and moisture of new clods
  kHeights0,  ///< new minus previous vertex height, one byte position per stream
  kHeights1,
  kHeights2,
  kHeights3,
  kPoints0,  ///< clod position minus predicted position, one byte position per stream
  kPoints1,
  kPoints2,
  kPoints3,
  kCount
};

/// Predicts the position of flying clods.
///
/// Model   a parabola through the last three positions of the clod with that number.
class GrainFlights {
 public:
  struct Flight {
    TerrainSurface::Grain last;
    std::array<std::array<std::int64_t, 3>, 3> past = {};  ///< [axis], newest first
    int known = 0;
  };
  /// The flight of a clod number; created if new.
  Flight& Of(std::uint16_t number) { return flights_[number]; }
  /// Predicted next position along an axis, as ordered bits.
  static std::int64_t Predict(const Flight& flight, int axis);
  static void Remember(const TerrainSurface::Grain& grain, Flight* flight);

 private:
  std::map<std::uint16_t, Flight> flights_;
};

/// Packs changes of the ground step by step, without loss.
class TerrainPacker {
 public:
  /// Adds a change relative to the ground `known`.
  void Add(const TerrainChange& change, const TerrainSurface& known);
  /// Appends the streams of all changes since the last call to `block`.
  void Take(Block* block);

 private:
  std::string& Of(TerrainStream stream) { return streams_[static_cast<std::size_t>(stream)]; }

  std::array<std::string, static_cast<std::size_t>(TerrainStream::kCount)> streams_;
  GrainFlights flights_;
  std::vector<std::uint16_t> numbers_;  ///< clod numbers of the previous step
};

/// Inverse of TerrainPacker.
class TerrainUnpacker {
 public:
  static constexpr std::size_t kStreams = static_cast<std::size_t>(TerrainStream::kCount);

  /// Takes the streams of a block, starting at stream `*stream`. Advances `*stream` past them.
  /// Returns false if streams are missing.
  bool Load(Block* block, std::size_t* stream);
  /// The next change, relative to the ground `known`. Returns false if no change is left or if it
  /// does not fit that ground.
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
