#pragma once

#include <vector>

#include "blind/plant/axis_form.h"
#include "core/random.h"

namespace tera::blind {

/// What one lever's messages are when they reach the valve: each sent once a period, looked at once
/// in a hold, late by a queue that keeps their order, followed by a spool that friction holds.
class Messages {
 public:
  Messages(const AxisForm& form, const Stream& stream) : form_(form), stream_(stream) {}

  void Send(double t_s, double lever);
  /// Where the spool is by the last that had come by then; neutral before.
  double At(double t_s);
  /// When the next one comes, at or after; far away where none is on its way.
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
