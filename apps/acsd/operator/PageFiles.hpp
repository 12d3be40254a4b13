#pragma once

#include <array>
#include <span>
#include <string_view>

namespace ACS::Acsd
{

/// A file that is part of the program.
struct EmbeddedFile
{
    std::string_view name;
    std::string_view content;
};

/// The files of the live page: apps/acsd/page, and Leaflet. cmake/AcsEmbedFiles.cmake generates the definition.
[[nodiscard]] std::span<const EmbeddedFile> GetPageFiles();

} // namespace ACS::Acsd
