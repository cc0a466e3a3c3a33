#include "sensors/camera/shutter.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {
namespace {

/// Exposure time of one row.
double Open_s(const ShutterModel& model, double exposure_s) {
  return model.motion_blur ? exposure_s : 0;
}

}  // namespace

void Serialize(ModelArchive* archive, ShutterModel* m) {
  constexpr double kMostPictures = 255;
  archive->Visit("readout_s", &m->readout_s, AtLeast(0, "s"));
  archive->Visit("motion_blur", &m->motion_blur);
  archive->Visit("step_px", &m->step_px, Between(0.05, 100, "px"));
  archive->Visit("most_pictures", &m->most_pictures, Between(1, kMostPictures, "pictures"));
  archive->Check(m->readout_s != 0 || m->motion_blur, "motion_blur",
                 "false beside readout_s 0: the shutter then makes nothing of motion; need a "
                 "readout_s above 0, motion_blur: true, or no shutter");
}

Exposures::Exposures(const ShutterModel& model, double exposure_s, int rows, int pictures)
    : readout_s_(model.readout_s),
      open_s_(Open_s(model, exposure_s)),
      slot_s_((readout_s_ + open_s_) / pictures),
      rows_(rows),
      pictures_(pictures) {
  TERA_CHECK(pictures % 2 == 1, pictures);
}

double Exposures::Reach_s(const ShutterModel& model, double exposure_s) {
  return 0.5 * (model.readout_s + Open_s(model, exposure_s));
}

int Exposures::PicturesFor(const ShutterModel& model, double motion_px) {
  const double needed = std::ceil(std::min(motion_px / model.step_px, 1e6));
  const int pictures = std::clamp(static_cast<int>(needed), 1, model.most_pictures);
  if (pictures % 2 == 1) return pictures;
  return pictures < model.most_pictures ? pictures + 1 : pictures - 1;
}

TimeNs Exposures::Instant_ns(int picture) const {
  return FromSeconds(slot_s_ * (picture - pictures_ / 2));
}

double Exposures::RowMiddle_s(int row) const {
  return rows_ > 1 ? readout_s_ * (static_cast<double>(row) / (rows_ - 1) - 0.5) : 0;
}

int Exposures::MiddleOf(int row) const {
  if (!(slot_s_ > 0)) return pictures_ / 2;
  const int slot = pictures_ / 2 + static_cast<int>(std::lround(RowMiddle_s(row) / slot_s_));
  return std::clamp(slot, 0, pictures_ - 1);
}

double Exposures::Share(int row, int picture) const {
  if (!(open_s_ > 0)) return MiddleOf(row) == picture ? 1 : 0;
  const double slot_middle_s = slot_s_ * (picture - pictures_ / 2), middle_s = RowMiddle_s(row);
  const double from_s = std::max(slot_middle_s - 0.5 * slot_s_, middle_s - 0.5 * open_s_);
  const double to_s = std::min(slot_middle_s + 0.5 * slot_s_, middle_s + 0.5 * open_s_);
  return std::max(0.0, to_s - from_s) / open_s_;
}

}  // namespace tera
