#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "soil/soil.h"

namespace tera {

/// Soil kinds of a site: each soil at one or more degrees of saturation. Every kind has its own
/// index.
///
/// Model   Each given soil is a kind. Further kinds are a given soil at another whole per cent of
///         saturation (AtMoisture).
class SoilKinds {
 public:
  static constexpr std::size_t kMost = 255;

  explicit SoilKinds(std::vector<SoilType> soils = {});

  /// All kinds, given soils first.
  const std::vector<SoilType>& soils() const { return soils_; }
  /// The kind of the same soil that is nearest to a degree of saturation.
  std::uint8_t At(std::uint8_t kind, double moisture) const;
  /// Adds the kind at the nearest whole per cent. False if there is no room.
  bool Add(std::uint8_t kind, double moisture);
  /// Adds hidden kinds of all soils that hold water, from the driest state to saturation. Their
  /// steps are the smallest of 1, 2, 5, 10 and 20 % that fit. False if none fits.
  bool AddHidden();
  /// The visible kind: the given soil for a hidden kind, otherwise the kind itself.
  std::uint8_t Shown(std::uint8_t kind) const { return kind < shown_ ? kind : given_[kind]; }
  std::size_t shown_count() const { return std::min(shown_, soils_.size()); }

 private:
  static constexpr int kPerCent = 100;
  /// index of a kind by per cent of saturation, -1 for none
  using Row = std::array<int, kPerCent + 1>;

  std::vector<SoilType> soils_;
  std::vector<std::uint8_t> given_;  ///< for each kind: index of its given soil
  std::vector<Row> kind_at_;         ///< for each given soil
  std::size_t shown_ = kMost;        ///< index of the first hidden kind
};

}  // namespace tera
