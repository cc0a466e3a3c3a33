#include "untrusted_file.h"
#include "view/viewed_index.h"

// A diagnosis.json as `tera view` reads it.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tera::Put("why/diagnosis.json", data, size);
  tera::Read([] { tera::DiagnosisIndexJson(tera::FuzzFolder() / "why"); });
  return 0;
}
