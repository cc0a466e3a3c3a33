#pragma once

#include <string>
#include <vector>

#include "blind/plant/excavator.h"
#include "blind/plant/plant.h"

namespace tera::blind {

/// Errors of one encoder, small and always present.
struct EncoderNoise {
  double rate_radps = 0.0035;    ///< standard deviation of the coloured part
  double memory = 0.5;           ///< correlation from one sample to the next
  double dof = 5;                ///< of its Student-t innovations
  double engine_radps = 0.0008;  ///< amplitude of the engine's line
  double engine_hz = 31;
  double rate_step_radps = 1.7e-4, angle_step_rad = 1.7e-4;  ///< quantisation
  double angle_rad = 3e-4;
  double lost = 0.02;      ///< share of samples, in runs of up to five
  double outlier = 0.001;  ///< share of samples with ten times the error
  double jitter_s = 3e-4;  ///< of the times of sampling
  double late_s = 0.001;   ///< constant delay of its stamps
};

/// Random noise of an encoder.
EncoderNoise DrawNoise(const Stream& stream);

/// The times at which samples are taken, at 100 Hz.
std::vector<double> SampleTimes(double duration_s, const EncoderNoise& noise, const Stream& stream);

/// Rows of an encoder channel.
struct EncoderRows {
  std::vector<std::size_t> axes;  ///< which are measured
  std::vector<long long> t_ns;
  std::vector<AxisValues> q_rad, w_radps;
  std::vector<std::size_t> sample;  ///< index in the motion, for each row
};

EncoderRows Measure(const Motion& motion, const std::vector<std::size_t>& axes,
                    const EncoderNoise& noise, const Stream& stream);

}  // namespace tera::blind
