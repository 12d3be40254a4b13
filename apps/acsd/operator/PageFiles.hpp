#pragma once

#include "operator/EmbeddedFile.hpp"

#include <array>
#include <span>

namespace ACS::Acsd
{

/// The files of the live page: apps/acsd/page, and Leaflet. cmake/AcsEmbedFiles.cmake generates the definition.
[[nodiscard]] std::span<const EmbeddedFile> GetPageFiles();

} // namespace ACS::Acsd
