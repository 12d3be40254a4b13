#pragma once

#include "common/config/ConfigReader.hpp"
#include "common/config/ConfigSection.hpp"
#include <acs/acsd/OptionTable.hpp>

#include <utility>

namespace ACS::Acsd
{

class OptionTable::Impl final
{
public:
    const Apps::ConfigReader reader; ///< Of the whole document.
    const Apps::ConfigSection section;

    Impl(Apps::ConfigReader ofDocument, Apps::ConfigSection table)
        : reader(std::move(ofDocument)),
          section(std::move(table))
    {
    }
};

/// The section, which is of the reader's document, for a driver.
[[nodiscard]] OptionTable MakeOptionTable(const Apps::ConfigReader& reader, Apps::ConfigSection section);

} // namespace ACS::Acsd
