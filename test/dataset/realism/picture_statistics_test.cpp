#include "dataset/realism/picture_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <unsupported/Eigen/FFT>

namespace tera {
namespace {

using Field = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic>;

/// The inverse transform of a square field.
Field InverseTransform(Field field) {
  Eigen::FFT<double> fft;
  for (int pass = 0; pass < 2; ++pass) {
    for (Eigen::Index k = 0; k < field.cols(); ++k) {
      Eigen::VectorXcd column = field.col(k), turned;
      fft.inv(turned, column);
      field.col(k) = turned;
    }
    field.transposeInPlace();
  }
  return field;
}

/// A picture whose amplitude falls as frequency to the power of `slope`, with random phases.
Image<float> PowerLaw(int side, double slope, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Field field(side, side);
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double f = std::hypot(std::min(i, side - i), std::min(j, side - j));
      const double amplitude = f > 0 ? std::pow(f, slope) : 0;
      field(j, i) = amplitude * std::complex<double>(normal(random), normal(random));
    }
  }
  field = InverseTransform(field);
  Image<float> picture(side, side);
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      picture.at(i, j) = static_cast<float>(1e4 * field(j, i).real() + 128);
    }
  }
  return picture;
}

// A ring of radius k has about 2 pi k amplitudes, Rayleigh distributed (deviation over mean 0.52)
// and equal in pairs. The logarithm of its mean errs by 0.52 / sqrt(pi k): 0.15 at the narrowest,
// 0.04 at the widest. Over four octaves that moves the slope by some 0.03.
TEST(AmplitudeSlope, IsThatOfNoiseOfAKnownPowerLaw) {
  for (const double slope : {0.0, -0.8, -1.2, -1.5}) {
    double mean = 0;
    for (unsigned seed = 1; seed <= 3; ++seed) {
      mean += AmplitudeSlope(PowerLaw(256, slope, seed)) / 3;
    }
    EXPECT_NEAR(mean, slope, 0.06) << slope;
  }
}

TEST(AmplitudeSlope, OfAnUprightPictureIsThatOfItsMiddleSquare) {
  const Image<float> square = PowerLaw(128, -1, 7);
  Image<float> framed(128, 200);
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) framed.at(x, y + 36) = square.at(x, y);
  }
  EXPECT_DOUBLE_EQ(AmplitudeSlope(framed), AmplitudeSlope(square));
}

TEST(GeneralisedGaussianShape, FollowsFromTheMomentsOfKnownDistributions) {
  // Gaussian: E|x| = sqrt(2 / pi) of its deviation; Laplacian: E x^2 = 2 (E|x|)^2.
  EXPECT_NEAR(GeneralisedGaussianShape(9, 3 * std::sqrt(2 / M_PI)), 2, 1e-9);
  EXPECT_NEAR(GeneralisedGaussianShape(2 * 0.25, 0.5), 1, 1e-9);
}

/// A grey picture of independent numbers about `middle`, rounded and cut to 8 bits.
template <typename Draw>
Image<std::uint8_t> Noise(int side, double middle, unsigned seed, Draw draw) {
  std::mt19937 random(seed);
  Image<std::uint8_t> picture(side, side, 3);
  for (int p = 0; p < side * side; ++p) {
    const double dn = std::clamp(std::round(middle + draw(random)), 0.0, 255.0);
    std::fill_n(&picture.data[3 * static_cast<std::size_t>(p)], 3, static_cast<std::uint8_t>(dn));
  }
  return picture;
}

SurfaceSums SumsOf(const Image<std::uint8_t>& picture) {
  SurfaceSums whole;
  std::vector<SurfaceSums> none;
  AddPicture(picture, {}, &whole, &none);
  return whole;
}

// The median of 250 x 250 mask responses, about a ninth of them independent, has a standard error
// of 1.17 sigma / sqrt(7000), 1.4 %. Rounding adds a variance of 1/12.
TEST(SurfaceSums, NoiseOfAFlatPictureIsItsDeviation) {
  for (const double sigma : {2.0, 5.0, 12.0}) {
    std::normal_distribution<double> normal(0, sigma);
    const double noise_dn = SumsOf(Noise(256, 120, 3, normal)).noise_dn();
    EXPECT_NEAR(noise_dn, std::sqrt(sigma * sigma + 1.0 / 12), 0.05 * sigma) << sigma;
  }
}

TEST(SurfaceSums, NoiseIsBlindToSlopesAndEdges) {
  Image<std::uint8_t> picture(128, 128, 3);
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) {
      for (int c = 0; c < 3; ++c) {
        picture.at(x, y, c) = static_cast<std::uint8_t>(x + (y > 64 ? 60 : 0));
      }
    }
  }
  EXPECT_LT(SumsOf(picture).noise_dn(), 0.05);
}

// Each value is part of the mean and the deviation that normalise it, which cuts its tails, so that
// noise is not at 2. With the weights of 7 x 7 at 7/6 px, NumPy's sums over 4.8 million numbers
// give 2.95 for normal ones of deviation 20, and 1.61 for Laplacian ones of scale 14.
TEST(SurfaceSums, MscnShapeOfWhiteNoiseIsThatOfTheSameSumsInNumPy) {
  std::normal_distribution<double> normal(0, 20);
  EXPECT_NEAR(SumsOf(Noise(384, 128, 5, normal)).mscn_shape(), 2.95, 0.06);
  const auto laplace = [](std::mt19937& random) {
    const double size = std::exponential_distribution<double>(1 / 14.0)(random);
    return random() % 2 == 0 ? size : -size;
  };
  EXPECT_NEAR(SumsOf(Noise(384, 128, 6, laplace)).mscn_shape(), 1.61, 0.04);
}

TEST(SurfaceSums, StepsBetweenIndependentLogarithmsHaveTheirKurtosis) {
  // Differences of two normal numbers are normal: 3. For two Laplacian ones the excess of 3 halves:
  // 4.5. Neighbouring steps share a pixel, so that fourth powers of 2 x 250 x 250 have a standard
  // error of some 0.03 and 0.1.
  const auto grey_of = [](double log_luminance) {
    const double y = std::exp(log_luminance) - 0.01;
    return 255 * (1.055 * std::pow(y, 1 / 2.4) - 0.055);
  };
  const double middle = std::log(0.25);
  const auto normal = [&](std::mt19937& random) {
    return grey_of(middle + std::normal_distribution<double>(0, 0.25)(random));
  };
  const auto laplace = [&](std::mt19937& random) {
    const double size = std::exponential_distribution<double>(1 / 0.12)(random);
    return grey_of(middle + (random() % 2 == 0 ? size : -size));
  };
  EXPECT_NEAR(SumsOf(Noise(256, 0, 1, normal)).step_kurtosis(), 3, 0.15);
  EXPECT_NEAR(SumsOf(Noise(256, 0, 2, laplace)).step_kurtosis(), 4.5, 0.4);
}

TEST(SurfaceSums, ClassesAreKeptApart) {
  // Left grey without noise, right a colour: sRGB (200, 100, 50) is Lab (53.6, 36.3, 45.4) by CIE
  // 15 with D65, with a chroma of 58.1.
  Image<std::uint8_t> rgb(128, 96, 3), semantic(128, 96);
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 128; ++x) {
      const bool right = x >= 64;
      semantic.at(x, y) = right ? 2 : 1;
      rgb.at(x, y, 0) = right ? 200 : 90;
      rgb.at(x, y, 1) = right ? 100 : 90;
      rgb.at(x, y, 2) = right ? 50 : 90;
    }
  }
  SurfaceSums whole;
  std::vector<SurfaceSums> of_class(3);
  AddPicture(rgb, semantic, &whole, &of_class);
  EXPECT_EQ(of_class[0].pixels(), 0);
  // 64 x 96 pixels without 3 at each side; a step also needs the next pixel inside.
  EXPECT_EQ(of_class[1].pixels(), 58 * 90);
  EXPECT_NEAR(of_class[1].chroma(), 0, 0.05);
  EXPECT_NEAR(of_class[2].chroma(), 58.1, 0.2);
}

TEST(Colourfulness, IsZeroOfGreyAndByHandOfRedAndBlack) {
  Image<std::uint8_t> picture(64, 64, 3);
  std::fill(picture.data.begin(), picture.data.end(), std::uint8_t{77});
  EXPECT_EQ(Colourfulness(picture), 0);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      picture.at(x, y, 0) = x < 32 ? 255 : 0;
      picture.at(x, y, 1) = picture.at(x, y, 2) = 0;
    }
  }
  // rg has mean and deviation 127.5, yb 63.75.
  EXPECT_NEAR(Colourfulness(picture), 1.3 * std::hypot(127.5, 63.75), 1e-3);
}

}  // namespace
}  // namespace tera
