#include "diagnose/statistics/tests/coherence.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <unsupported/Eigen/FFT>

#include "core/check.h"
#include "core/units.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

using Window = std::optional<Eigen::ArrayXcd>;

/// The spectrum of the Hann-weighted samples from `begin`; empty where too many are missing.
Window WindowSpectrum(const Series& series, std::size_t begin, const CoherenceOptions& options) {
  const std::size_t length = options.window;
  double mean = 0, count = 0;
  for (std::size_t k = 0; k < length; ++k) {
    count += series.valid[begin + k];
    mean += series.value[begin + k];
  }
  if (count < (1 - options.most_missing) * static_cast<double>(length)) return std::nullopt;
  mean /= count;
  std::vector<double> weighted(length, 0.0);
  for (std::size_t k = 0; k < length; ++k) {
    if (!series.valid[begin + k]) continue;
    const double phase = 2 * kPi * static_cast<double>(k) / static_cast<double>(length);
    weighted[k] = (series.value[begin + k] - mean) * (0.5 - 0.5 * std::cos(phase));
  }
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<std::complex<double>> spectrum;
  fft.fwd(spectrum, weighted);
  return Eigen::Map<Eigen::ArrayXcd>(spectrum.data() + 1,
                                     static_cast<Eigen::Index>(spectrum.size() - 1));
}

std::vector<Window> WindowSpectra(const Series& series, const CoherenceOptions& options) {
  std::vector<Window> out;
  for (std::size_t begin = 0; begin + options.window <= series.size();
       begin += options.window / 2) {
    out.push_back(WindowSpectrum(series, begin, options));
  }
  return out;
}

/// Coherence with window k of `a` paired with window k - offset of `b`, circularly.
Eigen::ArrayXd CoherenceAt(const std::vector<Window>& a, const std::vector<Window>& b,
                           std::size_t offset, Eigen::Index bins) {
  Eigen::ArrayXcd cross = Eigen::ArrayXcd::Zero(bins);
  Eigen::ArrayXd of_a = Eigen::ArrayXd::Zero(bins), of_b = Eigen::ArrayXd::Zero(bins);
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Window& other = b[(k + b.size() - offset) % b.size()];
    if (!a[k] || !other) continue;
    cross += *a[k] * other->conjugate();
    of_a += a[k]->abs2();
    of_b += other->abs2();
  }
  return cross.abs2() / (of_a * of_b).max(1e-300);
}

}  // namespace

Coherence TestCoherence(const Series& a, const Series& b, const CoherenceOptions& options,
                        const Stream& stream) {
  TERA_CHECK(a.size() == b.size(), a.size(), b.size());
  TERA_CHECK(options.window >= 8, options.window);
  Coherence out;
  const std::vector<Window> of_a = WindowSpectra(a, options), of_b = WindowSpectra(b, options);
  out.windows = of_a.size();
  if (out.windows < 8) return out;
  const auto bins = static_cast<Eigen::Index>(options.window / 2);
  const Eigen::ArrayXd observed = CoherenceAt(of_a, of_b, 0, bins);
  Eigen::Index peak = 0;
  const double largest = observed.maxCoeff(&peak);
  for (Eigen::Index k = 0; k < bins; ++k) {
    out.frequency_hz.push_back(static_cast<double>(k + 1) /
                               (static_cast<double>(options.window) * a.period_s));
    out.coherence.push_back(observed[k]);
  }
  out.peak_hz = out.frequency_hz[static_cast<std::size_t>(peak)];

  const std::size_t hop = options.window / 2;
  const std::size_t correlated = CorrelationLength(BridgedValues(b)) / hop;
  const CircularShifts shifts(out.windows, 2 + correlated, options.shifts, 0, stream);
  std::vector<double> shifted;
  for (std::size_t k = 0; k < shifts.count(); ++k) {
    shifted.push_back(CoherenceAt(of_a, of_b, shifts.offset(k, 0), bins).maxCoeff());
  }
  out.comparison = CompareWithShifts(largest, std::move(shifted));
  return out;
}

}  // namespace tera
