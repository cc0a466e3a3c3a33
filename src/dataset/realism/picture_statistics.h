#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/types/measurement.h"

/// Statistics that differ between photographs and rendered images.

namespace tera {

/// Slope of an image's amplitude spectrum over spatial frequency, in log-log scale.
///
/// Model   Takes the largest central square, subtracts its mean and applies a Hann window.
///         Amplitudes are averaged over direction in rings one cycle per picture wide. A
///         least-squares line is fitted to rings that are spaced uniformly in log frequency, from 4
///         cycles per picture to half of the finest frequency.
/// Source  Tolhurst, Tadmor and Chao 1992, "Amplitude spectra of natural images", for the slope;
///         van der Schaaf and van Hateren 1996 for the window.
double AmplitudeSlope(const Image<float>& luminance);

/// Shape parameter of a generalised Gaussian, p(x) ~ exp(-|x / scale|^shape), estimated from
/// moments. It is 2 for a Gaussian and 1 for a Laplacian; the result is clamped to [0.2, 10].
///
/// Model   E[x^2] / E[|x|]^2 = G(1/shape) G(3/shape) / G(2/shape)^2, where G is the gamma function.
/// Source  Sharifi and Leon-Garcia 1995.
double GeneralisedGaussianShape(double mean_square, double mean_absolute);

/// Sums over the pixels of one class in any number of images.
///
/// Model   Uses pixels whose whole 7 x 7 neighbourhood belongs to the class.
/// - MSCN: (I - m) / (s + 1) for luminance I in digital numbers (weights of ITU-R BT.601). m and s
///   are mean and standard deviation under a Gaussian of 7/6 px on 7 x 7 pixels.
/// - Steps: differences of ln(Y + 0.01) to the right and down, with the linear luminance Y in [0,
///   1].
/// - Chroma: C*ab of CIE Lab for daylight, D65.
/// - Noise: the median of |I * L| / (6 * 0.6745) with L = [1 -2 1; -2 4 -2; 1 -2 1], which
///   suppresses slopes and edges. It equals the standard deviation of white Gaussian noise. Fine
///   texture counts as noise.
///
/// Source  Mittal, Moorthy and Bovik 2012 (normalisation); Huang and Mumford 1999 (steps);
///         Immerkaer 1996 (the mask); Donoho and Johnstone 1994 (the median).
class SurfaceSums {
 public:
  SurfaceSums();

  void AddNormalised(double x);
  void AddStep(double step);
  void AddChroma(double chroma);
  void AddMask(double response);

  std::int64_t pixels() const { return pixels_; }
  double mscn_shape() const;
  double step_kurtosis() const;  ///< 3 for a Gaussian
  double chroma() const;
  double noise_dn() const;

 private:
  std::int64_t pixels_ = 0, steps_ = 0;
  double square_ = 0, absolute_ = 0, chroma_ = 0;
  std::array<double, 5> step_power_{};  ///< sums of the powers 0 to 4 of the steps
  std::vector<std::int64_t> mask_;      ///< histogram of |I * L|
};

/// Adds the pixels of an image: all to `whole`, and those of class c in `semantic` to
/// `of_class[c]`. `semantic` has the size of the image or is empty.
void AddPicture(const Image<std::uint8_t>& rgb, const Image<std::uint8_t>& semantic,
                SurfaceSums* whole, std::vector<SurfaceSums>* of_class);

/// Colourfulness of an image: 0 grey, 15 slightly, 33 moderately, 45 averagely, 59 quite, 82 highly
/// colourful.
///
/// Model   sqrt(s_rg^2 + s_yb^2) + 0.3 sqrt(m_rg^2 + m_yb^2), with standard deviations s and means
///         m of rg = R - G and yb = (R + G) / 2 - B.
/// Source  Hasler and Suesstrunk 2003, "Measuring colourfulness in natural images".
double Colourfulness(const Image<std::uint8_t>& rgb);

/// Luminance in digital numbers, with the weights of ITU-R BT.601.
Image<float> Luminance(const Image<std::uint8_t>& rgb);

}  // namespace tera
