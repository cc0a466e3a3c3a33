#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/types/measurement.h"

/// Statistics that separate photographs from rendered pictures.

namespace tera {

/// Slope of a picture's amplitude spectrum over spatial frequency, both logarithmic.
///
/// Model   the largest central square minus its mean, under a Hann window. Amplitudes are averaged
///         over all directions, in rings one cycle per picture wide. A least-squares line goes
///         through rings that are uniform in the logarithm of frequency, from 4 cycles per picture
///         to half of the finest.
/// Source  Tolhurst, Tadmor and Chao 1992, "Amplitude spectra of natural images", for the slope;
///         van der Schaaf and van Hateren 1996 for the window.
double AmplitudeSlope(const Image<float>& luminance);

/// Shape of a generalised Gaussian, p(x) ~ exp(-|x / scale|^shape), from moments. A Gaussian has 2,
/// a Laplacian 1. The result lies in [0.2, 10].
///
/// Model   E[x^2] / E[|x|]^2 = G(1/shape) G(3/shape) / G(2/shape)^2, where G is the gamma function.
/// Source  Sharifi and Leon-Garcia 1995.
double GeneralisedGaussianShape(double mean_square, double mean_absolute);

/// Sums over the pixels of one class, over any number of pictures.
///
/// Model   over the pixels whose whole 7 x 7 neighbourhood is of the class:
///         - luminance I in digital numbers (ITU-R BT.601's weights), mean-subtracted and
///           contrast-normalised: (I - m) / (s + 1), m and s mean and deviation under a Gaussian of
///           7/6 px, on 7 x 7;
///         - steps of ln(Y + 0.01) to the right and down, Y the linear luminance from 0 to 1;
///         - chroma C*ab of CIE Lab for daylight, D65;
///         - noise: the median of |I * L| / (6 * 0.6745), L = [1 -2 1; -2 4 -2; 1 -2 1], which
///           ignores slopes and edges; for white Gaussian noise its deviation. Fine texture counts
///           as noise.
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
  std::array<double, 5> step_power_{};  ///< sums of the powers of steps
  std::vector<std::int64_t> mask_;      ///< count of |I * L| in each bin
};

/// Adds the pixels of one picture: all to `whole`, and those of class c in `semantic` to
/// `of_class[c]`. `semantic` has the picture's size or is empty.
void AddPicture(const Image<std::uint8_t>& rgb, const Image<std::uint8_t>& semantic,
                SurfaceSums* whole, std::vector<SurfaceSums>* of_class);

/// Colourfulness of a picture: 0 grey, 15 slightly, 33 moderately, 45 averagely, 59 quite, 82
/// highly colourful.
///
/// Model   sqrt(s_rg^2 + s_yb^2) + 0.3 sqrt(m_rg^2 + m_yb^2), deviations and means of rg = R - G
///         and yb = (R + G) / 2 - B.
/// Source  Hasler and Suesstrunk 2003, "Measuring colourfulness in natural images".
double Colourfulness(const Image<std::uint8_t>& rgb);

/// Luminance of a picture in digital numbers, ITU-R BT.601's weights.
Image<float> Luminance(const Image<std::uint8_t>& rgb);

}  // namespace tera
