#pragma once

#include <string_view>

namespace ACS::Acsd
{

/// A file that is part of the program. cmake/AcsEmbedFiles.cmake generates it.
struct EmbeddedFile
{
    std::string_view name;
    std::string_view content;
};

} // namespace ACS::Acsd
