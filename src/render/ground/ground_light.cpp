#include "render/ground/ground_light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace tera {
namespace {

// Shadow depth below the ground at the border towards the sun.
constexpr float kNoShadowDepth_m = 100.0f;
constexpr int kLargestTexture = 4096;  // texels along a side

}  // namespace

void TexelWindow::Extend(int i, int j) {
  const bool first = empty();
  i0 = first ? i : std::min(i0, i);
  j0 = first ? j : std::min(j0, j);
  i1 = first ? i + 1 : std::max(i1, i + 1);
  j1 = first ? j + 1 : std::max(j1, j + 1);
}

void TexelWindow::Extend(const TexelWindow& other) {
  if (other.empty()) return;
  Extend(other.i0, other.j0);
  Extend(other.i1 - 1, other.j1 - 1);
}

TexelWindow TexelWindow::Within(const TexelWindow& other) const {
  return {std::max(i0, other.i0), std::max(j0, other.j0), std::min(i1, other.i1),
          std::min(j1, other.j1)};
}

TexelWindow TexelWindow::Grown(int texels) const {
  if (empty()) return *this;
  return {i0 - texels, j0 - texels, i1 + texels, j1 + texels};
}

std::vector<TexelWindow> Gathered(const std::vector<TexelWindow>& windows, int texels_of_a_window) {
  const auto area = [](const TexelWindow& w) {
    return static_cast<std::int64_t>(w.i1 - w.i0) * (w.j1 - w.j0);
  };
  std::vector<TexelWindow> gathered;
  for (TexelWindow window : windows) {
    if (window.empty()) continue;
    for (std::size_t k = 0; k < gathered.size();) {
      TexelWindow both = window;
      both.Extend(gathered[k]);
      if (area(both) > area(window) + area(gathered[k]) + texels_of_a_window) {
        ++k;
        continue;
      }
      window = both;
      gathered.erase(gathered.begin() + static_cast<std::ptrdiff_t>(k));
      k = 0;  // restart: the larger window may absorb others
    }
    gathered.push_back(window);
  }
  return gathered;
}

std::vector<TexelRow> RowsOf(const std::vector<TexelWindow>& windows) {
  std::vector<TexelRow> rows, apart;
  for (const TexelWindow& w : windows) {
    for (int j = w.j0; j < w.j1 && w.i0 < w.i1; ++j) rows.push_back({j, w.i0, w.i1});
  }
  std::sort(rows.begin(), rows.end(), [](const TexelRow& a, const TexelRow& b) {
    return std::pair(a.j, a.i0) < std::pair(b.j, b.i0);
  });
  for (const TexelRow& row : rows) {
    if (apart.empty() || apart.back().j != row.j || apart.back().i1 < row.i0) {
      apart.push_back(row);
    } else {
      apart.back().i1 = std::max(apart.back().i1, row.i1);
    }
  }
  return apart;
}

HeightTexels::HeightTexels(const TerrainGrid& grid)
    : texel_cells_((std::max(grid.nx, grid.ny) - 1) / kLargestTexture + 1),
      texel_m_(texel_cells_ * grid.cell_m) {
  width_ = (grid.nx - 1) / texel_cells_ + 1;
  height_ = (grid.ny - 1) / texel_cells_ + 1;
  height_m_.resize(static_cast<std::size_t>(width_) * height_);
}

TexelWindow HeightTexels::Of(int a, int b) const {
  constexpr int kCells = TerrainGrid::kTileCells;
  const auto first = [&](int tile) { return (tile * kCells + texel_cells_ - 1) / texel_cells_; };
  const auto end = [&](int tile) { return (tile + 1) * kCells / texel_cells_ + 1; };
  return {first(a), first(b), std::min(end(a), width_), std::min(end(b), height_)};
}

TexelWindow HeightTexels::Read(const TerrainSurface& terrain, const TexelWindow& window) {
  TexelWindow changed;
  for (int j = window.j0; j < window.j1; ++j) {
    for (int i = window.i0; i < window.i1; ++i) {
      float& height_m = height_m_[index(i, j)];
      const float now_m = terrain.height_m(i * texel_cells_, j * texel_cells_);
      if (height_m == now_m) continue;
      height_m = now_m;
      changed.Extend(i, j);
    }
  }
  return changed;
}

SkyView::SkyView(double texel_m) {
  constexpr std::array<std::array<int, 2>, 8> kDirections = {
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  constexpr std::array<double, 5> kReaches_m = {0.05, 0.15, 0.3, 0.6, kOcclusionReach_m};
  for (std::size_t d = 0; d < kDirections.size(); ++d) {
    const auto [x, y] = kDirections[d];
    const double unit = x != 0 && y != 0 ? std::sqrt(0.5) : 1.0;
    for (std::size_t r = 0; r < kReaches_m.size(); ++r) {
      const int steps = std::max(1, static_cast<int>(std::lround(kReaches_m[r] * unit / texel_m)));
      directions_[d][r] = {x * steps, y * steps, static_cast<float>(steps * texel_m / unit)};
      reach_texels_ = std::max(reach_texels_, steps);
    }
  }
}

float SkyView::Factor(const HeightTexels& heights, int i, int j) const {
  const float h = heights.at(i, j);
  float sum = 0;
  for (const auto& samples : directions_) {
    float steepest = 0;  // tangent of the horizon's elevation
    for (const Sample& s : samples) {
      const int a = std::clamp(i + s.di, 0, heights.width() - 1);
      const int b = std::clamp(j + s.dj, 0, heights.height() - 1);
      steepest = std::max(steepest, (heights.at(a, b) - h) / s.distance_m);
    }
    sum += 1.0f / (1.0f + steepest * steepest);
  }
  return sum / directions_.size();
}

void SkyView::Factors(const HeightTexels& heights, const TexelRow& row, float* factors) const {
  const int reach = reach_texels_;
  const bool is_inner = row.j >= reach && row.j + reach < heights.height();
  const int begin = is_inner ? std::clamp(reach, row.i0, row.i1) : row.i1;
  const int end = std::clamp(heights.width() - reach, begin, row.i1);
  for (int i = row.i0; i < begin; ++i) factors[i - row.i0] = Factor(heights, i, row.j);
  for (int i = begin; i < end; i += kAtOnce) {
    InnerFactors(heights, i, row.j, std::min(kAtOnce, end - i), factors + (i - row.i0));
  }
  for (int i = end; i < row.i1; ++i) factors[i - row.i0] = Factor(heights, i, row.j);
}

/// Vectorized Factor, for texels whose samples all lie within the terrain.
void SkyView::InnerFactors(const HeightTexels& heights, int i, int j, int count,
                           float* factors) const {
  const float* here_m = heights.from(i, j);
  std::array<float, kAtOnce> sum{}, steepest;
  for (const auto& samples : directions_) {
    steepest.fill(0);
    for (const Sample& s : samples) {
      const float* there_m = heights.from(i + s.di, j + s.dj);
      for (int k = 0; k < count; ++k) {
        const float tangent = (there_m[k] - here_m[k]) / s.distance_m;
        steepest[k] = std::max(steepest[k], tangent);
      }
    }
    for (int k = 0; k < count; ++k) sum[k] += 1.0f / (1.0f + steepest[k] * steepest[k]);
  }
  for (int k = 0; k < count; ++k) factors[k] = sum[k] / directions_.size();
}

/// Order of the lines for a shadow sweep: each line follows the line that can cast shadow on it.
struct GroundShadow::Sweep {
  bool along_x;       ///< lines are columns (constant i), else rows (constant j)
  int lines, across;  ///< number of lines, texels on each
  int first, step;    ///< first line and increment
  int whole;  ///< shift in texels along a line, per line towards the sun: whole and fractional part
  float part;
  float drop_m;  ///< fall of the shadow's height from line to line
  std::size_t line_stride, across_stride;

  Sweep(const HeightTexels& heights, const Vec3& to_sun_W) {
    along_x = std::abs(to_sun_W.x()) >= std::abs(to_sun_W.y());
    const double major = along_x ? to_sun_W.x() : to_sun_W.y();
    const double minor = along_x ? to_sun_W.y() : to_sun_W.x();
    lines = along_x ? heights.width() : heights.height();
    across = along_x ? heights.height() : heights.width();
    step = major > 0 ? -1 : 1;
    first = major > 0 ? lines - 1 : 0;
    const double drift = minor / std::abs(major);
    whole = static_cast<int>(std::floor(drift));
    part = static_cast<float>(drift - whole);
    drop_m = static_cast<float>(heights.texel_m() * to_sun_W.z() / std::abs(major));
    line_stride = along_x ? 1 : static_cast<std::size_t>(heights.width());
    across_stride = along_x ? static_cast<std::size_t>(heights.width()) : 1;
  }
  std::size_t index(int line, int k) const { return line * line_stride + k * across_stride; }
};

TexelWindow GroundShadow::Update(const HeightTexels& heights, const TexelWindow& changed) {
  TexelWindow shaded;
  const bool restart = shadow_m_.empty();
  const TexelWindow window =
      restart ? TexelWindow{0, 0, heights.width(), heights.height()} : changed;
  const auto free_m = [&](std::size_t k) { return heights.at(k) - kNoShadowDepth_m; };
  const auto put = [&](int i, int j, float value) {
    float& shadow_m = shadow_m_[heights.index(i, j)];
    if (shadow_m == value) return false;
    shadow_m = value;
    shaded.Extend(i, j);
    return true;
  };
  if (restart) {
    shadow_m_.assign(heights.index(0, heights.height()), -kNoShadowDepth_m);
    shaded = window;
  }
  const bool zenith = to_sun_W_.head<2>().norm() < 1e-6 * std::abs(to_sun_W_.z());
  const Sweep s(heights, zenith ? Vec3(Vec3::UnitX()) : to_sun_W_);
  const int n0 = s.along_x ? window.i0 : window.j0, n1 = s.along_x ? window.i1 : window.j1;
  const int k0 = s.along_x ? window.j0 : window.i0, k1 = s.along_x ? window.j1 : window.i1;
  // Texels [from, to) of the previous line have a changed height or shadow.
  int from = 0, to = 0;
  for (int line = s.step > 0 ? n0 : n1 - 1; line >= 0 && line < s.lines; line += s.step) {
    const bool inside = line >= n0 && line < n1;
    if (!inside && to <= from) break;
    // An occluder at k shades the texels between k - whole - 1 and k - whole.
    int a = to > from ? std::max(0, from - s.whole - 1) : s.across,
        b = std::min(s.across, to - s.whole);
    if (to > from && from == 0) a = 0;
    if (to > from && to == s.across) b = s.across;
    if (to <= from) b = 0;
    if (inside && (line == s.first || zenith)) a = std::min(a, k0), b = std::max(b, k1);
    from = s.across, to = 0;
    for (int k = a; k < b; ++k) {
      const std::size_t here = s.index(line, k);
      float value = free_m(here);
      if (line != s.first && !zenith) {
        const auto caster = [&](int m) {
          const std::size_t q = s.index(line - s.step, std::clamp(m, 0, s.across - 1));
          return std::max(heights.at(q), shadow_m_[q]);
        };
        const float near = caster(k + s.whole), far = caster(k + s.whole + 1);
        value = near + s.part * (far - near) - s.drop_m;
      }
      const int i = s.along_x ? line : k, j = s.along_x ? k : line;
      if (put(i, j, value)) from = std::min(from, k), to = std::max(to, k + 1);
    }
    if (inside) from = std::min(from, k0), to = std::max(to, k1);
  }
  return shaded;
}

}  // namespace tera
