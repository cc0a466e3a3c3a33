#pragma once

#include <vector>

#include "blind/plant/axis_form.h"
#include "core/random.h"

namespace tera::blind {

/// Messages of one lever on their way to the valve: sent periodically, sampled with a hold, delayed
/// by an ordered queue. A spool held by friction follows them.
class Messages {
 public:
  Messages(const AxisForm& form, const Stream& stream) : form_(form), stream_(stream) {}

  void Send(double t_s, double lever);
  /// Position of the spool after the last message received by then; neutral before the first.
  double At(double t_s);
  /// Arrival of the next message, at or after this time; far in the future if there is none.
  double Next(double t_s) const;

 private:
  struct Message {
    double comes_s, lever;
  };
  AxisForm form_;
  Stream stream_;
  std::vector<Message> sent_;
  std::size_t next_ = 0;
  double held_ = 0, looked_s_ = -1e9;
};

}  // namespace tera::blind
