#include "sensors/gnss/site_frame.h"

#include <GeographicLib/LocalCartesian.hpp>

namespace tera {

struct SiteFrame::Impl {
  GeographicLib::LocalCartesian plane;
};

SiteFrame::SiteFrame(double lat_deg, double lon_deg, double height_m)
    : impl_(
          std::make_unique<Impl>(Impl{GeographicLib::LocalCartesian(lat_deg, lon_deg, height_m)})) {
}
SiteFrame::~SiteFrame() = default;
SiteFrame::SiteFrame(SiteFrame&&) noexcept = default;

SiteFrame::Geodetic SiteFrame::ToGeodetic(const Vec3& p_W_m) const {
  Geodetic place{};
  impl_->plane.Reverse(p_W_m.x(), p_W_m.y(), p_W_m.z(), place.lat_deg, place.lon_deg,
                       place.height_m);
  return place;
}

Vec3 SiteFrame::ToEnu(const Geodetic& place) const {
  Vec3 p_W_m;
  impl_->plane.Forward(place.lat_deg, place.lon_deg, place.height_m, p_W_m.x(), p_W_m.y(),
                       p_W_m.z());
  return p_W_m;
}

}  // namespace tera
