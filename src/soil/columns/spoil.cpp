#include "soil/columns/spoil.h"

#include <algorithm>

namespace tera {

void Spoil::Add(const Spoil& other) {
  const double total_kg = mass_kg + other.mass_kg;
  if (total_kg > 0) {
    moisture += static_cast<float>((other.moisture - moisture) * other.mass_kg / total_kg);
  }
  mass_kg = total_kg;
  volume_m3 += other.volume_m3;
}

Spoil Spoil::Take(double f) {
  const Spoil part{mass_kg * f, volume_m3 * f, soil, moisture};
  mass_kg -= part.mass_kg;
  volume_m3 -= part.volume_m3;
  return part;
}

void SpoilMix::Add(const Spoil& spoil) {
  if (spoil.mass_kg <= 0) return;
  const auto at = std::lower_bound(parts_.begin(), parts_.end(), spoil.soil,
                                   [](const Spoil& p, std::uint8_t soil) { return p.soil < soil; });
  if (at != parts_.end() && at->soil == spoil.soil) {
    at->Add(spoil);
  } else {
    parts_.insert(at, spoil);
  }
}

void SpoilMix::Add(const SpoilMix& other) {
  for (const Spoil& part : other.parts_) Add(part);
}

SpoilMix SpoilMix::Take(double f) {
  SpoilMix taken;
  for (Spoil& part : parts_) taken.Add(part.Take(f));
  if (f >= 1) clear();
  return taken;
}

double SpoilMix::mass_kg() const {
  double sum_kg = 0;
  for (const Spoil& part : parts_) sum_kg += part.mass_kg;
  return sum_kg;
}

double SpoilMix::volume_m3() const {
  double sum_m3 = 0;
  for (const Spoil& part : parts_) sum_m3 += part.volume_m3;
  return sum_m3;
}

std::uint8_t SpoilMix::main_soil() const {
  const auto most =
      std::max_element(parts_.begin(), parts_.end(),
                       [](const Spoil& a, const Spoil& b) { return a.mass_kg < b.mass_kg; });
  return most == parts_.end() ? 0 : most->soil;
}

}  // namespace tera
