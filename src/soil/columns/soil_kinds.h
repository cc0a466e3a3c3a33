#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "soil/soil.h"

namespace tera {

/// A site's soils, each at several degrees of saturation: all of them have an index of their own.
///
/// Model   the soils that are given are kinds of themselves; others are theirs at a whole per cent
///         of saturation (AtMoisture).
class SoilKinds {
 public:
  static constexpr std::size_t kMost = 255;

  explicit SoilKinds(std::vector<SoilType> soils = {});

  /// All kinds, the given soils first.
  const std::vector<SoilType>& soils() const { return soils_; }
  /// The kind of a kind's soil that is nearest to a degree of saturation.
  std::uint8_t At(std::uint8_t kind, double moisture) const;
  /// Adds that of the very per cent; false if there is no more room.
  bool Add(std::uint8_t kind, double moisture);
  /// Adds kinds of all soils that hold water, from their driest state to saturation. Steps are as
  /// small as there is room for; false if there is none. They are shown as the given soil.
  bool AddHidden();
  /// The kind as which a kind is shown.
  std::uint8_t Shown(std::uint8_t kind) const { return kind < shown_ ? kind : given_[kind]; }
  std::size_t shown_count() const { return std::min(shown_, soils_.size()); }

 private:
  static constexpr int kPerCent = 100;
  using Row = std::array<int, kPerCent + 1>;  ///< kind by per cent of saturation, -1: none

  std::vector<SoilType> soils_;
  std::vector<std::uint8_t> given_;  ///< of each kind
  std::vector<Row> kind_at_;         ///< of each given soil
  std::size_t shown_ = kMost;        ///< kinds from here on are hidden
};

}  // namespace tera
