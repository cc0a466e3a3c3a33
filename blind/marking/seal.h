#pragma once

#include <filesystem>
#include <string>

namespace tera::blind {

// Binds the hidden truth to the answer, so that neither can be changed afterwards. The digest of
// the truth is written before the tool runs. After its answer follow the digest of the answer, that
// of both texts together, and only then the truth itself.

/// Lower-case hexadecimal SHA-256 of a text.
std::string Digest(const std::string& text);

/// Writes `folder`/seal.txt with the truth's digest.
void SealTruth(const std::string& truth, const std::filesystem::path& folder);
/// Adds the answer's digest, then writes truth.json.
void OpenTruth(const std::string& truth, const std::string& answer,
               const std::filesystem::path& folder);

}  // namespace tera::blind
