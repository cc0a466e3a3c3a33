#include "sim/state/packed_series.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using Rows = std::vector<double>;
using Limits = std::numeric_limits<double>;

/// Numbers are compared bitwise: NaN has many patterns, and 0 has two.
bool SameBits(const Rows& a, const Rows& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (std::bit_cast<std::uint64_t>(a[k]) != std::bit_cast<std::uint64_t>(b[k])) return false;
  }
  return true;
}

/// Packs the parts in sequence, unpacks them, and expects equality.
void ExpectLossless(std::size_t columns, const std::vector<Rows>& parts) {
  PackedSeries packer(columns), unpacker(columns);
  for (const Rows& rows : parts) {
    Block block = {"something before"};
    packer.Pack(rows, &block);
    ASSERT_EQ(block.size(), 1 + PackedSeries::kStreams);
    block.push_back("something behind");
    std::size_t stream = 1;
    Rows out;
    ASSERT_TRUE(unpacker.Unpack(block, rows.size() / columns, &stream, &out));
    EXPECT_EQ(stream, 1 + PackedSeries::kStreams);
    EXPECT_TRUE(SameBits(out, rows)) << rows.size() << " numbers in " << columns << " columns";
  }
}

Rows RandomBits(std::size_t count, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  Rows rows(count);
  for (double& x : rows) x = std::bit_cast<double>(random());
  return rows;
}

const Rows kAwkward = {0.0,
                       -0.0,
                       1.0,
                       -1.0,
                       Limits::infinity(),
                       -Limits::infinity(),
                       Limits::quiet_NaN(),
                       -Limits::quiet_NaN(),
                       std::bit_cast<double>(0x7ff0000000000001),  // signalling, least payload
                       std::bit_cast<double>(0xfff0000000000001),
                       std::bit_cast<double>(0x7fffffffffffffff),  // all payload
                       std::bit_cast<double>(0xffffffffffffffff),
                       std::bit_cast<double>(0x7ff8dead0000beef),
                       Limits::denorm_min(),
                       -Limits::denorm_min(),
                       std::bit_cast<double>(0x000fffffffffffff),  // largest denormal
                       Limits::min(),
                       -Limits::min(),
                       Limits::max(),
                       -Limits::max(),
                       Limits::epsilon()};

TEST(PackedSeries, GivesBackNumbersThatAreNone) {
  ExpectLossless(1, {kAwkward});
  ExpectLossless(kAwkward.size(), {kAwkward, kAwkward});
  ExpectLossless(3, {kAwkward});
}

TEST(PackedSeries, GivesBackEveryAwkwardNumberAfterEveryOther) {
  Rows pairs;
  for (const double a : kAwkward) {
    for (const double b : kAwkward) pairs.insert(pairs.end(), {a, b, b, a, a});
  }
  ExpectLossless(1, {pairs});
  ExpectLossless(5, {pairs});
}

TEST(PackedSeries, GivesBackRandomBits) {
  ExpectLossless(1, {RandomBits(5000, 1)});
  ExpectLossless(7, {RandomBits(7 * 500, 2), RandomBits(7, 3), RandomBits(7 * 40, 4)});
}

TEST(PackedSeries, GivesBackWhatPassesZeroSmoothly) {
  Rows rows;
  for (int k = -300; k <= 300; ++k) {
    rows.push_back(1e-3 * k);
    rows.push_back(std::sin(0.1 * k));
    rows.push_back(k * Limits::denorm_min());
    rows.push_back(std::exp(-std::abs(k)) * (k % 2 == 0 ? 1 : -1));
  }
  ExpectLossless(4, {rows});
}

TEST(PackedSeries, GoesOnFromOneCallToTheNext) {
  // In parts of 0 to 5 rows, fewer than a prediction needs.
  std::vector<Rows> parts;
  int k = 0;
  for (int length = 0; length < 40; ++length) {
    Rows& rows = parts.emplace_back();
    for (int row = 0; row < length % 6; ++row, ++k) {
      rows.insert(rows.end(), {std::cos(0.02 * k), 1e5 + k, -3});
    }
  }
  ExpectLossless(3, parts);
}

TEST(PackedSeries, OfNoRowsAndOfNoColumnsThereIsNothing) {
  ExpectLossless(4, {{}, {1, 2, 3, 4}, {}});
  PackedSeries packer(0), unpacker(0);
  Block block;
  packer.Pack({}, &block);
  std::size_t stream = 0;
  Rows out;
  EXPECT_TRUE(unpacker.Unpack(block, 5, &stream, &out));
  EXPECT_TRUE(out.empty());
}

/// Bytes in a file, minus those of a file without numbers.
std::int64_t CompressedBytes(std::size_t columns, const Rows& rows) {
  const ScratchDirectory scratch;
  const auto bytes = [&](const Block& block) {
    BlockFileWriter writer(scratch.path() / "series.blocks", "");
    writer.Append(block);
    writer.Commit();
    return writer.bytes();
  };
  Block block;
  PackedSeries(columns).Pack(rows, &block);
  return bytes(block) - bytes(Block(PackedSeries::kStreams));
}

// If the residual of a prediction is below 2^b in magnitude, it fills the lowest (b + 1) / 8 bytes
// with its sign, rounded up. The others are zero throughout. Random bytes do not compress and cost
// 3 bytes per 128 KiB and 14 per frame (RFC 8878 3.1.1). A stream of n zeros, n up to 128 KiB,
// takes 4 bytes more. The first three numbers have no prediction and take 8 bytes each; their
// positions in a stream take some tens of bytes of sequences. 400 bytes hold all this.
constexpr std::int64_t kOverhead = 400;

TEST(PackedSeries, WhatStaysOrGrowsEvenlyTakesAlmostNothing) {
  constexpr int kCount = 20000;
  Rows constant(kCount, 0.1), ramp, parabola;
  for (int k = 0; k < kCount; ++k) {
    // All in one binade and exact, so that a polynomial of the numbers is also one of their bits.
    ramp.push_back(1 + std::ldexp(k, -20));
    parabola.push_back(1 + std::ldexp(static_cast<double>(k) * k, -40));
  }
  EXPECT_LT(CompressedBytes(1, constant), kOverhead);
  EXPECT_LT(CompressedBytes(1, ramp), kOverhead);
  EXPECT_LT(CompressedBytes(1, parabola), kOverhead);
}

TEST(PackedSeries, ASmoothMotionTakesTheBytesOfItsThirdDifferences) {
  // x = 1.5 + 0.4 sin(w k), within one binade, whose spacing is 2^-52. Third differences are at
  // most 0.4 (2 sin(w / 2))^3, and rounding adds at most (1 + 3 + 3 + 1) / 2 of a spacing.
  constexpr int kCount = 20000;
  for (const double frequency_hz : {0.005, 0.05, 0.5, 5.0}) {
    const double w = 2 * std::numbers::pi * frequency_hz / 500;
    Rows rows;
    for (int k = 0; k < kCount; ++k) rows.push_back(1.5 + 0.4 * std::sin(w * k));
    const double left = std::ldexp(0.4 * std::pow(2 * std::sin(w / 2), 3), 52) + 4;
    const int bytes_each = static_cast<int>(std::ceil((std::log2(left) + 1) / 8));
    EXPECT_LT(bytes_each, 6);
    EXPECT_LE(CompressedBytes(1, rows), bytes_each * kCount + kOverhead) << frequency_hz << " Hz";
  }
}

TEST(PackedSeries, ColumnsDoNotSpoilOneAnother) {
  // Next to a column of random bits, a constant column still takes almost nothing. Streams hold
  // bytes of one weight of all columns, and zstd must find the zeros between them. Half of the
  // bytes of each stream are random. A Huffman code with probability 1/2 + 1/512 for zero takes 1
  // bit for a zero and at most 10 for another byte: 11 / 16 of the bytes.
  constexpr int kCount = 20000;
  const Rows random = RandomBits(kCount, 5);
  Rows rows;
  for (int k = 0; k < kCount; ++k) rows.insert(rows.end(), {random[k], 0.1});
  EXPECT_LT(CompressedBytes(2, rows), 8 * 2 * kCount * 11 / 16 + 8 * kOverhead);
}

TEST(PackedSeries, StreamsOfOtherRowsAreRefused) {
  Rows rows;
  for (int k = 0; k < 60; ++k) rows.insert(rows.end(), {0.1 * k, 5, -0.3 * k});
  Block good;
  PackedSeries(3).Pack(rows, &good);
  const auto unpacks = [&](const Block& block, std::size_t count, std::size_t columns = 3,
                           std::size_t stream = 0) {
    Rows out;
    return PackedSeries(columns).Unpack(block, count, &stream, &out);
  };
  ASSERT_TRUE(unpacks(good, 60));
  for (const std::size_t count : {0u, 1u, 59u, 61u, 1000000u}) EXPECT_FALSE(unpacks(good, count));
  EXPECT_FALSE(unpacks(good, ~std::size_t{0}));
  EXPECT_FALSE(unpacks(good, ~std::size_t{0} / 3 + 61));  // times 3, modulo 2^64, nearly 180
  EXPECT_FALSE(unpacks(good, 60, 2));
  EXPECT_FALSE(unpacks(good, 60, 4));
  EXPECT_FALSE(unpacks(good, 60, 3, 1));
  EXPECT_FALSE(unpacks(good, 60, 3, 100));
  EXPECT_FALSE(unpacks({}, 60));
  for (std::size_t s = 0; s < good.size(); ++s) {
    Block damaged = good;
    damaged[s].pop_back();
    EXPECT_FALSE(unpacks(damaged, 60)) << "stream " << s << " cut";
    damaged[s] = good[s] + "xx";
    EXPECT_FALSE(unpacks(damaged, 60)) << "stream " << s << " longer";
    damaged.resize(s);
    EXPECT_FALSE(unpacks(damaged, 60)) << s << " streams";
  }
}

TEST(PackedSeries, DamagedStreamsAreRefusedOrGiveOtherNumbers) {
  // Damaged bytes of numbers and degrees: invalid degrees are refused, and any other damage gives
  // the same count of numbers. Nothing reads out of bounds.
  Block good;
  const Rows rows = RandomBits(50, 6);
  PackedSeries(5).Pack(rows, &good);
  std::mt19937 random(8);
  int refused = 0;
  for (int k = 0; k < 3000; ++k) {
    Block damaged = good;
    std::string& stream = damaged[k % 2 == 0 ? 0 : random() % damaged.size()];
    stream[random() % stream.size()] = static_cast<char>(random());
    std::size_t at = 0;
    Rows out;
    if (PackedSeries(5).Unpack(damaged, 10, &at, &out)) {
      EXPECT_EQ(out.size(), 50u);
    } else {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
}

TEST(PackedSeries, BitsAreOrderedAsNumbersAre) {
  const double numbers[] = {-Limits::infinity(),
                            -Limits::max(),
                            -2,
                            -1.5,
                            -1,
                            -Limits::min(),
                            -Limits::denorm_min(),
                            -0.0,
                            0.0,
                            Limits::denorm_min(),
                            Limits::min(),
                            1,
                            1.5,
                            2,
                            Limits::max(),
                            Limits::infinity()};
  for (std::size_t k = 1; k < std::size(numbers); ++k) {
    EXPECT_LT(OrderedBits(numbers[k - 1]), OrderedBits(numbers[k])) << k;
    EXPECT_LT(OrderedBits(static_cast<float>(k - 1.0)), OrderedBits(static_cast<float>(k)));
    EXPECT_LT(OrderedBits(-static_cast<float>(k)), OrderedBits(static_cast<float>(1.0 - k)));
  }
  // Neighbours differ by one, also across zero, except between its two signs.
  for (const double x : {-3.7, -1.0, -Limits::denorm_min(), 0.0, 1.0, 1e300}) {
    EXPECT_EQ(OrderedBits(std::nextafter(x, Limits::infinity())), OrderedBits(x) + 1) << x;
  }
}

TEST(PackedSeries, BitsAreThoseOfTheSameNumberAgain) {
  for (const double x : kAwkward) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(FromOrderedBits(OrderedBits(x))),
              std::bit_cast<std::uint64_t>(x));
  }
  std::mt19937_64 random(9);
  for (int k = 0; k < 1000; ++k) {
    const std::uint64_t bits = random();
    EXPECT_EQ(
        std::bit_cast<std::uint64_t>(FromOrderedBits(OrderedBits(std::bit_cast<double>(bits)))),
        bits);
    const auto word = static_cast<std::uint32_t>(bits);
    EXPECT_EQ(
        std::bit_cast<std::uint32_t>(FromOrderedBits(OrderedBits(std::bit_cast<float>(word)))),
        word);
  }
}

TEST(PackedSeries, PolynomialsAreContinuedExactly) {
  const auto cubic_free = [](std::int64_t k, int degree) -> std::int64_t {
    return 7 + (degree > 0 ? -3 * k : 0) + (degree > 1 ? 5 * k * k : 0);
  };
  for (int degree = 0; degree <= 2; ++degree) {
    const std::int64_t newest_first[] = {cubic_free(12, degree), cubic_free(11, degree),
                                         cubic_free(10, degree)};
    EXPECT_EQ(Extrapolate(newest_first, degree), cubic_free(13, degree)) << degree;
  }
  // Beyond 64 bits it wraps around.
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  const std::int64_t rising[] = {kMost, kMost - 1, kMost - 2}, wild[] = {kMost, kLeast, kMost};
  EXPECT_EQ(Extrapolate(rising, 1), kLeast);
  EXPECT_EQ(Extrapolate(rising, 2), kLeast);
  // 3 (2^63 - 1) + 3 2^63 + (2^63 - 1) = 7 2^63 - 4, which is 2^63 - 4 modulo 2^64.
  EXPECT_EQ(Extrapolate(wild, 2), kMost - 3);
}

TEST(PackedSeries, SmallMagnitudesAreSmallNumbers) {
  EXPECT_EQ(ZigZag(0), 0u);
  EXPECT_EQ(ZigZag(-1), 1u);
  EXPECT_EQ(ZigZag(1), 2u);
  EXPECT_EQ(ZigZag(-2), 3u);
  EXPECT_EQ(ZigZag(std::numeric_limits<std::int64_t>::min()), ~std::uint64_t{0});
  for (const std::int64_t n :
       {0L, -1L, 77L, -123456789012L, std::numeric_limits<std::int64_t>::max(),
        std::numeric_limits<std::int64_t>::min()}) {
    EXPECT_EQ(FromZigZag(ZigZag(n)), n);
  }
}

}  // namespace
}  // namespace tera
