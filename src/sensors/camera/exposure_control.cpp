#include "sensors/camera/exposure_control.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tera {
namespace {

constexpr double kMostStep_ev = 4;  ///< limit of the correction per image

void SerializeLoop(ModelArchive* archive, ControlLoop* loop) {
  constexpr double kMostDelay = 100;
  MeteringZone& z = loop->zone;
  std::vector<double> sides{z.left, z.top, z.right, z.bottom};
  archive->Visit("zone", &sides, Between(0, 1, "of the picture"));
  z = {sides[0], sides[1], sides[2], sides[3]};
  archive->Check(z.left < z.right && z.top < z.bottom, "zone",
                 {FaultKind::kMissing,
                  "is empty; need [left, top, right, bottom] with left < right and "
                  "top < bottom"});
  archive->Visit("delay_pictures", &loop->delay_pictures, Between(1, kMostDelay, "pictures"));
  archive->Visit("rate", &loop->rate, {.min = 0, .max = 1, .min_excluded = true, .unit = "1"});
}

double Product_s(const PictureSettings& settings) {
  return settings.exposure_s * std::pow(10, settings.gain_db / 20);
}

/// Factor that moves `found` towards `wanted` by the share `rate` of the error in EV.
double Correction(double wanted, double found, double rate) {
  const double error_ev = std::log2(wanted / std::max(found, 1e-9));
  return std::exp2(rate * std::clamp(error_ev, -kMostStep_ev, kMostStep_ev));
}

}  // namespace

void Serialize(ModelArchive* archive, AutomaticExposure* m) {
  SerializeLoop(archive, m);
  archive->Visit("target", &m->target, Between(0.01, 0.9, "of the range"));
  archive->Visit("shortest_s", &m->shortest_s, Positive("s"));
  archive->Visit("longest_s", &m->longest_s, Positive("s"));
  archive->Check(m->longest_s >= m->shortest_s, "longest_s",
                 "below shortest_s; need shortest_s <= longest_s");
  archive->Visit("least_gain_db", &m->least_gain_db, Between(0, 48, "dB"));
  archive->Visit("most_gain_db", &m->most_gain_db, Between(0, 48, "dB"));
  archive->Check(m->most_gain_db >= m->least_gain_db, "most_gain_db",
                 "below least_gain_db; need least_gain_db <= most_gain_db");
}

void Serialize(ModelArchive* archive, AutomaticWhiteBalance* m) {
  SerializeLoop(archive, m);
  archive->Visit("most", &m->most, Between(1, 100, "1"));
}

ExposureControl::ExposureControl(const std::optional<AutomaticExposure>& exposure,
                                 const std::optional<AutomaticWhiteBalance>& balance,
                                 const PictureSettings& start)
    : exposure_(exposure), balance_(balance), start_(start) {
  if (exposure_) product_s_.assign(exposure_->delay_pictures, Product_s(start));
  if (balance_) balances_.assign(balance_->delay_pictures, start.balance);
}

void ExposureControl::Split(double product_s, PictureSettings* settings) const {
  const double least_gain = std::pow(10, exposure_->least_gain_db / 20);
  settings->exposure_s =
      std::clamp(product_s / least_gain, exposure_->shortest_s, exposure_->longest_s);
  const double gain_db = 20 * std::log10(product_s / settings->exposure_s);
  settings->gain_db = std::clamp(gain_db, exposure_->least_gain_db, exposure_->most_gain_db);
}

PictureSettings ExposureControl::Settings() const {
  PictureSettings settings = start_;
  if (exposure_) Split(product_s_.front(), &settings);
  if (balance_) settings.balance = balances_.front();
  return settings;
}

void ExposureControl::Take(const Metered& for_exposure, const Metered& for_balance) {
  const PictureSettings used = Settings();
  if (exposure_) {
    const double factor = Correction(exposure_->target, for_exposure.signal, exposure_->rate);
    product_s_.pop_front();
    product_s_.push_back(Product_s(used) * factor);
  }
  if (balance_) {
    Vec3 next = used.balance;
    const Vec3& colour = for_balance.colour;
    for (const int c : {0, 2}) {
      if (!(colour[1] > 0 && colour[c] > 0)) continue;  // no signal in this colour
      const double wanted = used.balance[1] * colour[1] / colour[c];
      next[c] *= Correction(wanted, used.balance[c], balance_->rate);
      next[c] = std::clamp(next[c], 1 / balance_->most, balance_->most);
    }
    balances_.pop_front();
    balances_.push_back(next);
  }
}

}  // namespace tera
