#include "soil/site/geotiff.h"
#include "soil/site/survey_raster.h"
#include "untrusted_file.h"

// A GeoTIFF as a site's heights, as its soils, and as a survey. GDAL decodes it; its results are
// not trusted.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tera::ReadAsFile("a.tif", data, size, tera::ReadElevation);
  tera::Read([] { tera::ReadSoilClasses(tera::FuzzFolder() / "a.tif", std::nullopt); });
  tera::Read([] { tera::ReadSurveyRaster(tera::FuzzFolder() / "a.tif"); });
  return 0;
}
