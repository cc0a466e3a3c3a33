#include "sim/state/packed_terrain.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "core/check.h"
#include "sim/state/packed_series.h"

namespace tera {
namespace {

using Grain = TerrainSurface::Grain;

constexpr int kAxes = 3;
constexpr int kNumberBits = 7;  ///< payload bits per byte; the eighth bit marks a continuation

void AppendNumber(std::uint64_t n, std::string* bytes) {
  for (; n >> kNumberBits; n >>= kNumberBits) bytes->push_back(static_cast<char>(n | 0x80));
  bytes->push_back(static_cast<char>(n));
}

/// Reduces a 33-bit difference of two 32-bit integers to 32 bits.
std::uint32_t Wrapped(std::int64_t rest) {
  return static_cast<std::uint32_t>(
      ZigZag(static_cast<std::int32_t>(static_cast<std::uint32_t>(rest))));
}

std::uint32_t BitsOf(const TerrainSurface::Cover& cover) {
  static_assert(sizeof cover == sizeof(std::uint32_t));
  return std::bit_cast<std::uint32_t>(cover);
}

std::int64_t PlaceOf(const TerrainSurface& ground, int i, int j) {
  return static_cast<std::int64_t>(j) * ground.nx + i;
}

/// Compares the properties that do not change during a clod's flight.
bool IsSameGrain(const Grain& a, const Grain& b) {
  return a.radius_m == b.radius_m && a.soil == b.soil && a.moisture == b.moisture;
}

}  // namespace

std::int64_t GrainFlights::Predict(const Flight& flight, int axis) {
  if (flight.known == 0) return 0;
  return Extrapolate(flight.past[axis].data(), flight.known - 1);
}

void GrainFlights::Remember(const Grain& grain, Flight* flight) {
  flight->last = grain;
  flight->known = std::min(flight->known + 1, kAxes);
  for (int axis = 0; axis < kAxes; ++axis) {
    auto& past = flight->past[axis];
    past = {OrderedBits(grain.p_W_m[axis]), past[0], past[1]};
  }
}

void TerrainPacker::Add(const TerrainChange& change, const TerrainSurface& known) {
  const auto add_rest = [&](TerrainStream lowest, std::int64_t rest) {
    const std::uint32_t wrapped = Wrapped(rest);
    for (int p = 0; p < 4; ++p) {
      streams_[static_cast<std::size_t>(lowest) + p].push_back(
          static_cast<char>(wrapped >> (8 * p)));
    }
  };
  for (const std::size_t n :
       {change.refined_tiles.size(), change.vertices.size(), change.grains.size()}) {
    AppendNumber(n, &Of(TerrainStream::kCounts));
  }
  for (const int tile : change.refined_tiles) {
    AppendNumber(static_cast<std::uint64_t>(tile), &Of(TerrainStream::kTiles));
  }
  std::int64_t place = 0;
  for (const TerrainChange::At& at : change.vertices) {
    const std::int64_t next = PlaceOf(known, at.i, at.j);
    AppendNumber(ZigZag(next - std::exchange(place, next)), &Of(TerrainStream::kPlaces));
    const TerrainSurface::Vertex before = known.AsSet(at.i, at.j);
    add_rest(TerrainStream::kHeights0,
             std::int64_t{OrderedBits(at.vertex.height_m)} - OrderedBits(before.height_m));
    const std::uint32_t cover = BitsOf(at.vertex.cover) ^ BitsOf(before.cover);
    Of(TerrainStream::kCovers).append(reinterpret_cast<const char*>(&cover), sizeof cover);
  }
  for (std::size_t g = 0; g < change.grains.size(); ++g) {
    const Grain& grain = change.grains[g];
    const std::uint16_t before = g < numbers_.size() ? numbers_[g] : 0;
    AppendNumber(ZigZag(grain.number - before), &Of(TerrainStream::kNumbers));
    GrainFlights::Flight& flight = flights_.Of(grain.number);
    std::string& newborn = Of(TerrainStream::kNewborn);
    if (flight.known == 0 || !IsSameGrain(grain, flight.last)) {
      flight.known = 0;
      newborn.push_back(1);
      newborn.append(reinterpret_cast<const char*>(&grain.radius_m), sizeof grain.radius_m);
      newborn.push_back(static_cast<char>(grain.soil));
      newborn.push_back(static_cast<char>(grain.moisture));
    } else {
      newborn.push_back(0);
    }
    for (int axis = 0; axis < kAxes; ++axis) {
      add_rest(TerrainStream::kPoints0,
               OrderedBits(grain.p_W_m[axis]) - GrainFlights::Predict(flight, axis));
    }
    GrainFlights::Remember(grain, &flight);
  }
  numbers_.clear();
  for (const Grain& grain : change.grains) numbers_.push_back(grain.number);
}

void TerrainPacker::Take(Block* block) {
  for (std::string& stream : streams_) block->push_back(std::exchange(stream, {}));
}

bool TerrainUnpacker::Load(Block* block, std::size_t* stream) {
  if (*stream + kStreams > block->size()) return false;
  for (Cursor& cursor : streams_) cursor = {std::move((*block)[(*stream)++]), 0};
  return true;
}

bool TerrainUnpacker::Byte(TerrainStream stream, std::uint8_t* value) {
  Cursor& cursor = streams_[static_cast<std::size_t>(stream)];
  if (cursor.at >= cursor.bytes.size()) return false;
  *value = static_cast<std::uint8_t>(cursor.bytes[cursor.at++]);
  return true;
}

bool TerrainUnpacker::Number(TerrainStream stream, std::uint64_t* value) {
  *value = 0;
  std::uint8_t byte = 0x80;
  for (int shift = 0; byte & 0x80; shift += kNumberBits) {
    if (shift > 63 || !Byte(stream, &byte)) return false;
    *value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
  }
  return true;
}

bool TerrainUnpacker::Rest32(TerrainStream lowest, std::int64_t* value) {
  std::uint32_t wrapped = 0;
  for (int p = 0; p < 4; ++p) {
    std::uint8_t byte = 0;
    if (!Byte(static_cast<TerrainStream>(static_cast<int>(lowest) + p), &byte)) return false;
    wrapped |= static_cast<std::uint32_t>(byte) << (8 * p);
  }
  *value = FromZigZag(wrapped);
  return true;
}

bool TerrainUnpacker::Next(const TerrainSurface& known, TerrainChange* change) {
  *change = {};
  std::uint64_t tiles = 0, vertices = 0, grains = 0;
  for (std::uint64_t* n : {&tiles, &vertices, &grains}) {
    if (!Number(TerrainStream::kCounts, n)) return false;
  }
  for (std::uint64_t t = 0; t < tiles; ++t) {
    std::uint64_t tile = 0;
    if (!Number(TerrainStream::kTiles, &tile)) return false;
    if (tile >= static_cast<std::uint64_t>(known.tile_count())) return false;
    change->refined_tiles.push_back(static_cast<int>(tile));
  }
  std::int64_t place = 0;
  for (std::uint64_t v = 0; v < vertices; ++v) {
    if (!NextVertex(known, &place, change)) return false;
  }
  for (std::uint64_t g = 0; g < grains; ++g) {
    if (!NextGrain(g, change)) return false;
  }
  numbers_.clear();
  for (const Grain& grain : change->grains) numbers_.push_back(grain.number);
  return true;
}

bool TerrainUnpacker::NextVertex(const TerrainSurface& known, std::int64_t* place,
                                 TerrainChange* change) {
  std::uint64_t step = 0;
  std::int64_t rest = 0;
  if (!Number(TerrainStream::kPlaces, &step)) return false;
  const auto places = static_cast<std::int64_t>(known.nx) * known.ny;
  if (step > static_cast<std::uint64_t>(2 * places)) return false;
  *place += FromZigZag(step);
  if (*place < 0 || *place >= places) return false;
  TerrainChange::At at{
      static_cast<int>(*place % known.nx), static_cast<int>(*place / known.nx), {}};
  if (!Rest32(TerrainStream::kHeights0, &rest)) return false;
  const TerrainSurface::Vertex before = known.AsSet(at.i, at.j);
  at.vertex.height_m = FromOrderedBits(
      static_cast<std::int32_t>(static_cast<std::uint32_t>(OrderedBits(before.height_m) + rest)));
  std::uint32_t cover = 0;
  for (int p = 0; p < 4; ++p) {
    std::uint8_t byte = 0;
    if (!Byte(TerrainStream::kCovers, &byte)) return false;
    cover |= static_cast<std::uint32_t>(byte) << (8 * p);
  }
  at.vertex.cover = std::bit_cast<TerrainSurface::Cover>(cover ^ BitsOf(before.cover));
  change->vertices.push_back(at);
  return true;
}

bool TerrainUnpacker::NextGrain(std::size_t index, TerrainChange* change) {
  std::uint64_t number = 0;
  std::uint8_t is_new = 0;
  if (!Number(TerrainStream::kNumbers, &number)) return false;
  Grain grain;
  grain.number = static_cast<std::uint16_t>((index < numbers_.size() ? numbers_[index] : 0) +
                                            FromZigZag(number));
  GrainFlights::Flight& flight = flights_.Of(grain.number);
  if (!Byte(TerrainStream::kNewborn, &is_new)) return false;
  if (is_new) {
    flight.known = 0;
    std::uint32_t radius = 0;
    for (int p = 0; p < 4; ++p) {
      std::uint8_t byte = 0;
      if (!Byte(TerrainStream::kNewborn, &byte)) return false;
      radius |= static_cast<std::uint32_t>(byte) << (8 * p);
    }
    grain.radius_m = std::bit_cast<float>(radius);
    if (!Byte(TerrainStream::kNewborn, &grain.soil)) return false;
    if (!Byte(TerrainStream::kNewborn, &grain.moisture)) return false;
  } else {
    if (flight.known == 0) return false;
    grain.radius_m = flight.last.radius_m;
    grain.soil = flight.last.soil;
    grain.moisture = flight.last.moisture;
  }
  for (int axis = 0; axis < kAxes; ++axis) {
    std::int64_t rest = 0;
    if (!Rest32(TerrainStream::kPoints0, &rest)) return false;
    const auto bits = static_cast<std::uint32_t>(GrainFlights::Predict(flight, axis) + rest);
    grain.p_W_m[axis] = FromOrderedBits(static_cast<std::int32_t>(bits));
  }
  GrainFlights::Remember(grain, &flight);
  change->grains.push_back(grain);
  return true;
}

}  // namespace tera
