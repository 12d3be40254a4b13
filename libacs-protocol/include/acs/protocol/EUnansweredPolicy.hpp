#pragma once

#include <cstdint>

namespace ACS::Protocol
{

/// What a report gets that the application does not answer in time, or that arrives while too many reports wait.
enum class EUnansweredPolicy : std::uint8_t
{
    Fail,    ///< The Ack Fail, which is final: the ACS does not send the report again.
    Silence, ///< No Ack: the ACS sends the report again, and it is delivered again.
};

} // namespace ACS::Protocol
