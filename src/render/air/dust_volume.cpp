#include "render/air/dust_volume.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"

namespace tera {
namespace {

constexpr int kOctaves = 4;
constexpr int kCoarsest = 4;  ///< number of wavelengths of the first octave per period

int Wrapped(int i, int n) { return ((i % n) + n) % n; }

/// Weights of a linear blend of two values, scaled so that the blend has the variance of the
/// values.
struct Blend {
  int a, b;
  double wa, wb;
};

Blend BlendAt(double x, int n) {
  const double cell = std::floor(x), f = x - cell;
  const double s = f * f * (3 - 2 * f), norm = 1 / std::hypot(1 - s, s);
  const int i = static_cast<int>(cell);
  return {Wrapped(i, n), Wrapped(i + 1, n), (1 - s) * norm, s * norm};
}

/// Adds noise of unit variance from a lattice with `n` nodes along each axis.
void AddOctave(int n, double amplitude, std::vector<double>* sum) {
  constexpr int kSide = DustEddies::kSide;
  const Stream stream(static_cast<std::uint64_t>(n), "render/dust_eddies");
  const auto node = [&](int i, int j, int k) {
    return stream.Gaussian((static_cast<std::uint64_t>(k) * n + j) * n + i);
  };
  std::vector<double> nodes;
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) nodes.push_back(node(i, j, k));
    }
  }
  const auto at = [&](int i, int j, int k) {
    return nodes[(static_cast<std::size_t>(k) * n + j) * n + i];
  };
  const double per_texel = static_cast<double>(n) / kSide;
  std::size_t index = 0;
  for (int k = 0; k < kSide; ++k) {
    const Blend z = BlendAt((k + 0.5) * per_texel, n);
    for (int j = 0; j < kSide; ++j) {
      const Blend y = BlendAt((j + 0.5) * per_texel, n);
      for (int i = 0; i < kSide; ++i) {
        const Blend x = BlendAt((i + 0.5) * per_texel, n);
        const auto row = [&](int b, int c) { return x.wa * at(x.a, b, c) + x.wb * at(x.b, b, c); };
        const auto plane = [&](int c) { return y.wa * row(y.a, c) + y.wb * row(y.b, c); };
        (*sum)[index++] += amplitude * (z.wa * plane(z.a) + z.wb * plane(z.b));
      }
    }
  }
}

/// A position between two cell centres, with the index of the lower cell.
struct Between {
  int i;
  double f;
};

Between BetweenMiddles(double x_cells) {
  const double low = std::floor(x_cells - 0.5);
  return {static_cast<int>(low), x_cells - 0.5 - low};
}

}  // namespace

DustEddies::DustEddies() {
  std::vector<double> logarithm(static_cast<std::size_t>(kSide) * kSide * kSide, 0.0);
  double amplitude = 1, squares = 0;
  for (int octave = 0, n = kCoarsest; octave < kOctaves; ++octave, n *= 2) {
    AddOctave(n, amplitude, &logarithm);
    squares += amplitude * amplitude;
    amplitude /= std::cbrt(2.0);
  }
  double mean = 0;
  for (double& value : logarithm) {
    value = std::exp(kSpread * value / std::sqrt(squares));
    mean += value / static_cast<double>(logarithm.size());
  }
  for (const double value : logarithm) factors_.push_back(static_cast<float>(value / mean));
}

double DustEddies::At(const Vec3& p_m) const {
  constexpr double kPerMetre = kSide / kPeriod_m;
  const Between x = BetweenMiddles(p_m.x() * kPerMetre), y = BetweenMiddles(p_m.y() * kPerMetre),
                z = BetweenMiddles(p_m.z() * kPerMetre);
  const std::array<int, 2> i = {Wrapped(x.i, kSide), Wrapped(x.i + 1, kSide)};
  double sum = 0;
  for (int c = 0; c < 2; ++c) {
    for (int b = 0; b < 2; ++b) {
      const std::size_t row =
          (static_cast<std::size_t>(Wrapped(z.i + c, kSide)) * kSide + Wrapped(y.i + b, kSide)) *
          kSide;
      const double along = (1 - x.f) * factors_[row + i[0]] + x.f * factors_[row + i[1]];
      sum += (c == 0 ? 1 - z.f : z.f) * (b == 0 ? 1 - y.f : y.f) * along;
    }
  }
  return sum;
}

// Fresh coarse dust absorbs more than dust after long transport: 0.70 to 0.97 of its extinction at
// 550 nm is scattering (Ryder et al. 2013, Atmos. Chem. Phys. 13). Blue light is absorbed more than
// red (Dubovik et al. 2002, J. Atmos. Sci. 59; also source of kAsymmetry). The values themselves
// are this project's estimate from photographs of work on loam.
const Eigen::Vector3f DustVolume::kScattered(0.93f, 0.86f, 0.75f);

double DustVolume::Extinction_1pm(const Vec3& p_W_m) const {
  if (occupied_W_m.isEmpty()) return 0;
  const double gx = (p_W_m.x() - origin_W_m.x()) / cell_m;
  const double gy = (p_W_m.y() - origin_W_m.y()) / cell_m;
  const Between x = BetweenMiddles(gx), y = BetweenMiddles(gy);
  if (x.i < -1 || y.i < -1 || x.i >= nx || y.i >= ny) return 0;
  double base = 0;
  for (int b = 0; b < 2; ++b) {
    for (int a = 0; a < 2; ++a) {
      const int i = std::clamp(x.i + a, 0, nx - 1), j = std::clamp(y.i + b, 0, ny - 1);
      base += (a == 0 ? 1 - x.f : x.f) * (b == 0 ? 1 - y.f : y.f) *
              base_m[static_cast<std::size_t>(j) * nx + i];
    }
  }
  const Between z = BetweenMiddles(std::max((p_W_m.z() - base) / cell_m, 0.5));
  if (z.i >= nz) return 0;
  double sum = 0;
  for (int c = 0; c < 2; ++c) {
    for (int b = 0; b < 2; ++b) {
      for (int a = 0; a < 2; ++a) {
        const int i = x.i + a, j = y.i + b, k = z.i + c;
        if (i < 0 || j < 0 || i >= nx || j >= ny || k >= nz) continue;
        sum += (a == 0 ? 1 - x.f : x.f) * (b == 0 ? 1 - y.f : y.f) * (c == 0 ? 1 - z.f : z.f) *
               extinction_1pm[(static_cast<std::size_t>(k) * ny + j) * nx + i];
      }
    }
  }
  if (sum <= 0) return 0;
  return eddies ? sum * eddies->At(p_W_m - drift_m) : sum;
}

DustySpan SpanOf(const DustVolume& dust, const Vec3& origin_W_m, const Vec3& unit_W,
                 double range_m) {
  if (dust.occupied_W_m.isEmpty()) return {0, 0};
  double from = 0, to = range_m;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = dust.occupied_W_m.min()[axis] - origin_W_m[axis];
    const double high = dust.occupied_W_m.max()[axis] - origin_W_m[axis];
    if (unit_W[axis] == 0) {
      if (low > 0 || high < 0) return {0, 0};
      continue;
    }
    const double a = low / unit_W[axis], b = high / unit_W[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return {from, to};
}

double OpticalDepth(const DustVolume& dust, const Vec3& origin_W_m, const Vec3& unit_W,
                    double range_m) {
  const DustySpan span = SpanOf(dust, origin_W_m, unit_W, range_m);
  if (span.from_m >= span.to_m) return 0;
  const int steps = static_cast<int>(std::ceil((span.to_m - span.from_m) / MarchStep_m(dust)));
  const double step_m = (span.to_m - span.from_m) / steps;
  double sum = 0;
  for (int s = 0; s < steps; ++s) {
    sum += dust.Extinction_1pm(origin_W_m + (span.from_m + (s + 0.5) * step_m) * unit_W);
  }
  return sum * step_m;
}

}  // namespace tera
