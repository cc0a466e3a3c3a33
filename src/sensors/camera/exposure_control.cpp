#include "sensors/camera/exposure_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tera {
namespace {

constexpr double kMostStep_ev = 4;  ///< of what one picture may ask for

void ReadLoop(const ConfigMap& config, ControlLoop* loop) {
  constexpr double kMostDelay = 100;
  if (config.Has("zone")) {
    const std::vector<double> sides = config.Numbers("zone", Between(0, 1, "of the picture"), 4, 4);
    if (sides.size() == 4) {
      loop->zone = {sides[0], sides[1], sides[2], sides[3]};
      if (!(sides[0] < sides[2] && sides[1] < sides[3])) {
        config.Fault("zone",
                     "is empty; need [left, top, right, bottom] with left < right and "
                     "top < bottom");
      }
    }
  }
  loop->delay_pictures = static_cast<int>(
      config.Integer("delay_pictures", Between(1, kMostDelay, "pictures"), loop->delay_pictures));
  loop->rate =
      config.Number("rate", {.min = 0, .max = 1, .min_excluded = true, .unit = "1"}, loop->rate);
}

std::string LoopYaml(const ControlLoop& loop) {
  const MeteringZone& z = loop.zone;
  return fmt::format("      zone: [{}, {}, {}, {}]\n      delay_pictures: {}\n      rate: {}\n",
                     z.left, z.top, z.right, z.bottom, loop.delay_pictures, loop.rate);
}

double Product_s(const PictureSettings& settings) {
  return settings.exposure_s * std::pow(10, settings.gain_db / 20);
}

/// The factor that brings `found` towards `wanted`.
double Correction(double wanted, double found, double rate) {
  const double error_ev = std::log2(wanted / std::max(found, 1e-9));
  return std::exp2(rate * std::clamp(error_ev, -kMostStep_ev, kMostStep_ev));
}

}  // namespace

AutomaticExposure ReadAutomaticExposure(const ConfigMap& config) {
  AutomaticExposure m;
  ReadLoop(config, &m);
  m.target = config.Number("target", Between(0.01, 0.9, "of the range"), m.target);
  m.shortest_s = config.Number("shortest_s", Positive("s"), m.shortest_s);
  m.longest_s = config.Number("longest_s", Positive("s"), m.longest_s);
  if (m.longest_s < m.shortest_s) {
    config.Fault("longest_s", "below shortest_s; need shortest_s <= longest_s");
  }
  m.least_gain_db = config.Number("least_gain_db", Between(0, 48, "dB"), m.least_gain_db);
  m.most_gain_db = config.Number("most_gain_db", Between(0, 48, "dB"), m.most_gain_db);
  if (m.most_gain_db < m.least_gain_db) {
    config.Fault("most_gain_db", "below least_gain_db; need least_gain_db <= most_gain_db");
  }
  return m;
}

AutomaticWhiteBalance ReadAutomaticWhiteBalance(const ConfigMap& config) {
  AutomaticWhiteBalance m;
  ReadLoop(config, &m);
  m.most = config.Number("most", Between(1, 100, "1"), m.most);
  return m;
}

std::string AutomaticExposureYaml(const AutomaticExposure& m) {
  return LoopYaml(m) + fmt::format(
                           "      target: {}\n      shortest_s: {}\n      longest_s: {}\n"
                           "      least_gain_db: {}\n      most_gain_db: {}\n",
                           m.target, m.shortest_s, m.longest_s, m.least_gain_db, m.most_gain_db);
}

std::string AutomaticWhiteBalanceYaml(const AutomaticWhiteBalance& m) {
  return LoopYaml(m) + fmt::format("      most: {}\n", m.most);
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
      if (!(colour[1] > 0 && colour[c] > 0)) continue;  // nothing to be seen of it
      const double wanted = used.balance[1] * colour[1] / colour[c];
      next[c] *= Correction(wanted, used.balance[c], balance_->rate);
      next[c] = std::clamp(next[c], 1 / balance_->most, balance_->most);
    }
    balances_.pop_front();
    balances_.push_back(next);
  }
}

}  // namespace tera
