#pragma once

#include <string_view>

#include "diagnose/statistics/regime/regime_curve.h"

namespace tera {

enum class CurveForm {
  kNone,        ///< no significant deviation from a constant
  kLinear,      ///< proportional to the variable
  kSmooth,      ///< proportional to |x|, x^2 or x |x|
  kSaturating,  ///< grows up to a bend on both sides, constant beyond
  kThreshold,   ///< constant up to a bend, grows beyond (dead zone)
  kStep,        ///< jump
  kLocal,       ///< differs from a constant only in an interval about 0
  kPeriodic,    ///< sine of an angle, one to four periods per turn
  kLevels,      ///< variable with few values, none of the above
  kFree,        ///< none of these
};

enum class CurveParity { kNotTested, kOdd, kEven, kNeither };

/// Form and parity of a regime curve.
///
/// Model   each form is a family of one to three coefficients. Some have a bend, which is tried at
///         39 positions. gain = 2 log(L / L_constant) under the information of the curve. The form
///         with the largest gain - (coefficients + bends) log(rows) wins. Parity compares odd and
///         even piecewise-linear functions of |x|, if both signs occur. The curve differs from a
///         constant in [low, high]: between the bends (saturating, local), beyond them (threshold:
///         `outside`), about the jump (step), where nine tenths of its energy lie (free), else over
///         the whole visited range.
/// Source  Schwarz 1978.
struct CurveShape {
  CurveForm form = CurveForm::kNone;
  CurveParity parity = CurveParity::kNotTested;
  double low = 0, high = 0;
  bool outside = false;  ///< the curve differs from a constant outside [low, high]
  /// |x| of the bend; x of a jump or one-sided threshold; harmonic of a periodic form
  double bend = 0;
  double slope = 0;  ///< first coefficient of the form
  double gain = 0, free_gain = 0;
};

CurveShape ClassifyCurve(const RegimeCurve& curve);

std::string_view NameOf(CurveForm form);
std::string_view NameOf(CurveParity parity);

}  // namespace tera
