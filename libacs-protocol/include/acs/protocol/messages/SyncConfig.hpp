#pragma once

#include <acs/core/JsonText.hpp>

namespace ACS::Protocol
{

/// MCS to ACS: struck out in section 6.9 without defined members, so any object is carried as it is.
struct SyncConfig
{
    Core::JsonText content = Core::JsonText::FromTrusted("{}");

    bool operator==(const SyncConfig&) const = default;
};

} // namespace ACS::Protocol
