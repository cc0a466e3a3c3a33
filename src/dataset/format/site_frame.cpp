#include "dataset/format/site_frame.h"

#include <GeographicLib/LocalCartesian.hpp>

namespace tera {

struct SiteFrame::Impl {
  GeographicLib::LocalCartesian plane;
};

SiteFrame::SiteFrame(const Geodetic& origin)
    : impl_(std::make_shared<const Impl>(
          Impl{GeographicLib::LocalCartesian(origin.lat_deg, origin.lon_deg, origin.height_m)})) {}

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
