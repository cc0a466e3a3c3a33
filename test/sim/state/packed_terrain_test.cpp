#include "sim/state/packed_terrain.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <random>

#include "dataset/format/sample_recording.h"
#include "sim/state/changing_ground.h"

namespace tera {
namespace {

/// Changes of a ground and their packed streams.
struct Packed {
  TerrainSurface start, end;
  std::vector<Block> blocks;
  std::vector<int> steps;               ///< of each block
  std::vector<TerrainSurface> grounds;  ///< after each step
};

using Worker = std::function<void(TerrainSurface*)>;

Packed Pack(const TerrainSurface& start, const std::vector<int>& steps, const Worker& work) {
  Packed packed{.start = start, .end = start, .blocks = {}, .steps = steps, .grounds = {}};
  TerrainTracker tracker(start);
  TerrainPacker packer;
  for (const int count : steps) {
    for (int k = 0; k < count; ++k) {
      work(&packed.end);
      const TerrainChange change = tracker.Find(packed.end);
      packer.Add(change, tracker.known());
      tracker.Accept(change);
      packed.grounds.push_back(packed.end);
    }
    Block& block = packed.blocks.emplace_back(Block{"before"});
    packer.Take(&block);
    block.push_back("behind");
  }
  return packed;
}

void ExpectLossless(const Packed& packed) {
  TerrainUnpacker unpacker;
  TerrainSurface ground = packed.start;
  std::size_t step = 0;
  for (std::size_t b = 0; b < packed.blocks.size(); ++b) {
    Block block = packed.blocks[b];
    ASSERT_EQ(block.size(), 2 + TerrainUnpacker::kStreams);
    std::size_t stream = 1;
    ASSERT_TRUE(unpacker.Load(&block, &stream));
    EXPECT_EQ(stream, 1 + TerrainUnpacker::kStreams);
    for (int k = 0; k < packed.steps[b]; ++k, ++step) {
      TerrainChange change;
      ASSERT_TRUE(unpacker.Next(ground, &change)) << "step " << step;
      Apply(change, &ground);
      ASSERT_EQ(Difference(ground, packed.grounds[step]), "") << "step " << step;
    }
    TerrainChange change;
    EXPECT_FALSE(unpacker.Next(ground, &change)) << "there are steps behind the last";
  }
}

Worker AtWork(std::uint32_t seed) {
  return [work = std::make_shared<GroundAtWork>(seed)](TerrainSurface* g) { work->Step(g); };
}

TEST(PackedTerrain, GivesBackWhateverHappensToAGround) {
  ExpectLossless(Pack(UnevenGround(), {1, 30, 0, 2, 60}, AtWork(1)));
  ExpectLossless(Pack(UnevenGround(2, 2, 1), {40, 40}, AtWork(2)));
  ExpectLossless(Pack(UnevenGround(51, 51, 50), {40, 1}, AtWork(3)));
  ExpectLossless(Pack(UnevenGround(3, 160, 5), {25, 25}, AtWork(4)));
}

TEST(PackedTerrain, GivesBackAGroundThatRests) {
  ExpectLossless(Pack(UnevenGround(), {0, 100, 1}, [](TerrainSurface*) {}));
}

TEST(PackedTerrain, GivesBackEveryVertexOfASite) {
  ExpectLossless(Pack(UnevenGround(), {2}, [](TerrainSurface* ground) {
    for (int j = 0; j < ground->ny; ++j) {
      for (int i = 0; i < ground->nx; ++i) {
        TerrainSurface::Vertex vertex = ground->at(i, j);
        vertex.height_m = std::sin(1.7f * static_cast<float>(i * j)) - 2 * vertex.height_m;
        vertex.cover.rut = static_cast<std::uint8_t>(i + j);
        ground->Set(i, j, vertex);
      }
    }
  }));
}

TEST(PackedTerrain, GivesBackHeightsOfAnyBits) {
  std::mt19937 random(5);
  ExpectLossless(Pack(UnevenGround(), {50}, [&](TerrainSurface* ground) {
    for (int k = 0; k < 50; ++k) {
      const int i = static_cast<int>(random() % 118), j = static_cast<int>(random() % 163);
      float height_m = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
      if (std::isnan(height_m)) height_m = std::numeric_limits<float>::infinity();
      ground->Set(i, j, {height_m, {}});
    }
  }));
}

TEST(PackedTerrain, GivesBackGrainsOfAnyBits) {
  std::mt19937 random(6);
  const auto any = [&] { return std::bit_cast<float>(static_cast<std::uint32_t>(random())); };
  ExpectLossless(Pack(UnevenGround(), {20, 20}, [&](TerrainSurface* ground) {
    std::vector<TerrainSurface::Grain> grains(random() % 40);
    for (TerrainSurface::Grain& grain : grains) {
      grain.p_W_m = {any(), any(), any()};  // NaN, infinities and denormals among them
      grain.radius_m = any();
      grain.number = static_cast<std::uint16_t>(random());
      grain.soil = static_cast<std::uint8_t>(random());
      grain.moisture = static_cast<std::uint8_t>(random());
    }
    ground->SetGrains(grains);
  }));
}

TEST(PackedTerrain, GivesBackGrainsThatShareANumberAndChangeTheirKind) {
  // Two grains that separate under one number; a grain whose radius and soil change in flight; one
  // that is absent for some steps; at times all in another order.
  int k = 0;
  ExpectLossless(Pack(UnevenGround(), {30, 30}, [&](TerrainSurface* ground) {
    const double t = 0.02 * ++k;
    TerrainSurface::Grain other = GrainAt(7, {1 + t, -t, 2 - 5 * t * t}, 0.03f);
    if (k > 17) other.soil = 4;
    if (k > 23) other.radius_m = 0.031f;
    if (k > 29) other.moisture = 9;
    std::vector<TerrainSurface::Grain> grains = {GrainAt(7, {-t, t, 2 - 5 * t * t}, 0.02f), other};
    if (k % 9 < 5) grains.push_back(GrainAt(65535, {0, 0, t}));
    if (k % 4 == 0) std::swap(grains.front(), grains.back());
    ground->SetGrains(grains);
  }));
}

std::int64_t CompressedBytes(const Packed& packed) {
  const ScratchDirectory scratch;
  BlockFileWriter writer(scratch.path() / "terrain.blocks", "");
  for (const Block& block : packed.blocks) writer.Append(block);
  writer.Commit();
  return writer.bytes();
}

TEST(PackedTerrain, AGroundThatRestsTakesAlmostNothing) {
  // A stream of 100000 equal bytes is a run of at most some tens of bytes; there are few streams.
  const Packed packed = Pack(UnevenGround(51, 51, 50), {20000}, [](TerrainSurface*) {});
  EXPECT_LT(CompressedBytes(packed), 600);
}

TEST(PackedTerrain, ClodsInFreeFallTakeFewerBytesThanTheirPlaces) {
  // 40 clods on parabolas: numbers, radii and kinds stay, which leaves three coordinates of 4
  // bytes. A parabola's third difference is 0. Coordinates between 2 and 4 m are rounded to 2^-22
  // m, with an error of at most (1 + 3 + 3 + 1) / 2 of that. The residual with its sign is thus
  // below 2^4 and fills one byte of each.
  constexpr int kSteps = 500, kClods = 40;
  int k = 0;
  const Packed packed = Pack(UnevenGround(51, 51, 50), {kSteps}, [&](TerrainSurface* ground) {
    const double t = 0.001 * ++k;
    std::vector<TerrainSurface::Grain> grains;
    for (int n = 0; n < kClods; ++n) {
      grains.push_back(GrainAt(n, {2.5 + 0.01 * n * t, 3 - 0.02 * n * t, 3.5 - 4.905 * t * t}));
    }
    ground->SetGrains(grains);
  });
  // Initially three places of 12 bytes each, the clod's kind, and a byte for its number.
  EXPECT_LT(CompressedBytes(packed), 3 * kSteps * kClods + kClods * (3 * 12 + 8 + 1) + 1000);
}

TEST(PackedTerrain, AVertexThatSinksALittleTakesFewBytes) {
  // 100 adjacent vertices sink by some 1e-5 m at heights from 0.5 to 1 m, whose spacing is 2^-24 m.
  // A step of 1e-5 m is 168 spacings, below 2^9 with its sign, hence two bytes. A place relative to
  // the previous one takes at most one more, a change of cover one.
  constexpr int kSteps = 200, kVertices = 100;
  TerrainSurface start(TerrainGrid{.nx = 118, .ny = 163});
  for (int i = 0; i < kVertices; ++i) start.Set(i, 60, {0.95f, {}});
  const Packed packed = Pack(start, {kSteps}, [&](TerrainSurface* ground) {
    for (int i = 0; i < kVertices; ++i) {
      TerrainSurface::Vertex vertex = ground->at(i, 60);
      vertex.height_m -= 1e-5f + 1e-7f * static_cast<float>(i);
      ground->Set(i, 60, vertex);
    }
  });
  EXPECT_LT(CompressedBytes(packed), 4 * kSteps * kVertices + 1000);
}

/// Reads the expected steps of each block and applies them as far as possible. Returns whether all
/// were present.
bool Replay(const std::vector<Block>& blocks, const std::vector<int>& steps,
            TerrainSurface* ground) {
  TerrainUnpacker unpacker;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    Block block = blocks[b];
    std::size_t stream = 1;
    if (!unpacker.Load(&block, &stream)) return false;
    for (int k = 0; k < steps[b]; ++k) {
      TerrainChange change;
      if (!unpacker.Next(*ground, &change)) return false;
      for (const int tile : change.refined_tiles) {
        EXPECT_TRUE(tile >= 0 && tile < ground->tile_count()) << tile;
      }
      for (const TerrainChange::At& at : change.vertices) {
        EXPECT_TRUE(ground->Contains(at.i, at.j)) << at.i << " " << at.j;
      }
      if (testing::Test::HasFailure()) return false;
      Apply(change, ground);
    }
  }
  return true;
}

TEST(PackedTerrain, DamagedStreamsAreRefusedOrGiveAnotherGroundOfTheSameSite) {
  const Packed packed = Pack(UnevenGround(), {20, 20}, AtWork(7));
  std::mt19937 random(8);
  int refused = 0;
  for (int k = 0; k < 800; ++k) {
    std::vector<Block> blocks = packed.blocks;
    for (int n = 1 + static_cast<int>(random() % 3); n > 0; --n) {
      Block& block = blocks[random() % blocks.size()];
      std::string& stream = block[1 + random() % TerrainUnpacker::kStreams];
      if (stream.empty()) continue;
      const std::size_t at = random() % stream.size();
      switch (random() % 5) {
        case 0:
          stream[at] = static_cast<char>(random());
          break;
        case 1:
          stream[at] = static_cast<char>(stream[at] ^ (1 << random() % 8));
          break;
        case 2:
          stream.resize(at);
          break;
        case 3:
          stream.insert(at, std::string(1 + random() % 12, '\xff'));
          break;
        default:
          stream.erase(at, 1 + random() % 4);
      }
    }
    TerrainSurface ground = packed.start;
    if (!Replay(blocks, packed.steps, &ground)) ++refused;
    ASSERT_FALSE(HasFailure()) << k;
  }
  EXPECT_GT(refused, 300);
}

TEST(PackedTerrain, StreamsOfAnotherGroundAreRefusedOrStayWithinIt) {
  const Packed packed = Pack(UnevenGround(), {30}, AtWork(9));
  for (const auto& [nx, ny] : {std::pair{2, 2}, {51, 51}, {60, 20}, {20, 400}}) {
    TerrainSurface smaller = UnevenGround(nx, ny, 1);
    Replay(packed.blocks, packed.steps, &smaller);
    ASSERT_FALSE(HasFailure()) << nx << " x " << ny;
  }
  TerrainSurface tiny = UnevenGround(2, 2, 1);
  EXPECT_FALSE(Replay(packed.blocks, packed.steps, &tiny));
}

TEST(PackedTerrain, AbsurdCountsAreRefusedAtOnce) {
  // Numbers in groups of 7 bits or in fixed widths: of this stream any count is enormous.
  const Packed packed = Pack(UnevenGround(), {5}, AtWork(10));
  for (const std::size_t length : {1u, 9u, 10u, 11u, 64u, 4000u}) {
    for (std::size_t s = 0; s < TerrainUnpacker::kStreams; ++s) {
      std::vector<Block> blocks = packed.blocks;
      blocks[0][1 + s] = std::string(length, '\xff');
      TerrainSurface ground = packed.start;
      const bool is_read = Replay(blocks, packed.steps, &ground);
      ASSERT_FALSE(HasFailure()) << s;
      EXPECT_FALSE(s == 0 && is_read) << length;
      blocks[0][1 + s] = std::string(length - 1, '\xff') + '\x7f';
      ground = packed.start;
      Replay(blocks, packed.steps, &ground);
      ASSERT_FALSE(HasFailure()) << s;
    }
  }
}

TEST(PackedTerrain, MissingStreamsAreRefused) {
  const Packed packed = Pack(UnevenGround(), {5}, AtWork(11));
  for (std::size_t count = 0; count < 1 + TerrainUnpacker::kStreams; ++count) {
    Block block = packed.blocks[0];
    block.resize(count);
    std::size_t stream = 1;
    EXPECT_FALSE(TerrainUnpacker().Load(&block, &stream)) << count;
  }
  Block block = packed.blocks[0];
  std::size_t beyond = 100;
  EXPECT_FALSE(TerrainUnpacker().Load(&block, &beyond));
  TerrainChange change;
  EXPECT_FALSE(TerrainUnpacker().Next(packed.start, &change));  // nothing was loaded
}

}  // namespace
}  // namespace tera
