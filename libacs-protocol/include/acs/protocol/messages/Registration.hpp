#pragma once

namespace ACS::Protocol
{

/// ACS to MCS: the first message of every connection; carries nothing (section 6.2).
struct Registration
{
    bool operator==(const Registration&) const = default;
};

} // namespace ACS::Protocol
