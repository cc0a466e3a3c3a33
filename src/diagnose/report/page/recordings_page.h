#pragma once

#include <string>
#include <vector>

#include "diagnose/recordings/shared_causes.h"

namespace tera {

/// One recording on the page of several: its name and the page of its own report.
struct RecordingOnPage {
  std::string name, page;
  const Diagnosis* diagnosis = nullptr;
};

/// The page of several recordings of one machine: shared causes first, a table of causes by
/// recordings, and the findings of each recording tested on the others.
std::string RecordingsPage(const std::string& machine,
                           const std::vector<RecordingOnPage>& recordings,
                           const std::vector<SharedCause>& causes);

}  // namespace tera
