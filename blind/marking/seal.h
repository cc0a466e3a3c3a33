#pragma once

#include <filesystem>
#include <string>

namespace tera::blind {

// Ties what was hidden to what was answered, so that neither can be changed for the other: before
// the tool runs, the digest of the truth is written; when it has answered, that of the answer and
// that of both texts together; only then the truth itself.

/// Lower-case hexadecimal SHA-256 of a text.
std::string Digest(const std::string& text);

/// Writes `folder`/seal.txt with the truth's digest.
void SealTruth(const std::string& truth, const std::filesystem::path& folder);
/// Adds the answer's, then writes truth.json.
void OpenTruth(const std::string& truth, const std::string& answer,
               const std::filesystem::path& folder);

}  // namespace tera::blind
