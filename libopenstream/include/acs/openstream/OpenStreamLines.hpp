#pragma once

#include <acs/core/JsonText.hpp>
#include <acs/openstream/EOpenStreamErrorCode.hpp>
#include <acs/openstream/EStopTarget.hpp>

#include <optional>
#include <string>
#include <variant>

namespace ACS::OpenStream
{

struct HandshakeAck
{
    bool bOk = true;
    std::string version; ///< "MAJOR.MINOR.PATCH"; empty where the server sent none.

    bool operator==(const HandshakeAck&) const = default;
};

struct MonitorAck
{
    bool operator==(const MonitorAck&) const = default;
};

/// One sample of a MONITOR.
struct DataLine
{
    double ts = 0.0;                      ///< ms on a clock of the server: only differences mean anything.
    double serviceDurationMs = 0.0;       ///< How long the server took for the GET.
    std::optional<Core::JsonText> result; ///< The body of the GET.
    std::optional<int> status;            ///< HTTP status where there was no body or no success.
    std::optional<Core::JsonText> id;     ///< What the MONITOR gave.

    bool operator==(const DataLine&) const = default;
};

struct StopAck
{
    EStopTarget target = EStopTarget::Monitor;

    bool operator==(const StopAck&) const = default;
};

/// A CONTROL that the service refused (`control_err`). Does not say which one.
struct ControlError
{
    int status = 0; ///< HTTP.
    std::optional<Core::JsonText> body;

    bool operator==(const ControlError&) const = default;
};

/// What is wrong with a command, or why the session ends (`error`). Does not say with which command.
struct ErrorLine
{
    EOpenStreamErrorCode code = EOpenStreamErrorCode::Unknown;
    std::string codeText; ///< As it stood on the wire; not used when encoding.
    std::string message;
    std::string hint; ///< Left out where empty.

    bool operator==(const ErrorLine&) const = default;
};

/// Everything that a server sends.
using OpenStreamLine = std::variant<HandshakeAck, MonitorAck, DataLine, StopAck, ControlError, ErrorLine>;

} // namespace ACS::OpenStream
