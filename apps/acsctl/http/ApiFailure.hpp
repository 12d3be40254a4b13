#pragma once

#include <cstdint>
#include <string>

namespace ACS::Acsctl
{

enum class EApiFailure : std::uint8_t
{
    CannotConnect, ///< No request was sent.
    ConnectionLost,
    TimedOut,
    BadAnswer, ///< Not HTTP, or too long.
    Interrupted,
};

/// Why a request has no answer.
struct ApiFailure
{
    EApiFailure kind = EApiFailure::CannotConnect;
    std::string text;        ///< A sentence without its full stop.
    bool bSent = false;      ///< acsd may have received the request.
    bool bStreaming = false; ///< The header of a stream with status 200 had arrived.
};

} // namespace ACS::Acsctl
