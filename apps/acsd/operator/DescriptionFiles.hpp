#pragma once

#include "operator/EmbeddedFile.hpp"

#include <array>
#include <span>

namespace ACS::Acsd
{

/// docs/reference/openapi.json, the only one. cmake/AcsEmbedFiles.cmake generates the definition.
[[nodiscard]] std::span<const EmbeddedFile> GetDescriptionFiles();

} // namespace ACS::Acsd
