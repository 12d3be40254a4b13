#pragma once

#include <acs/core/JsonText.hpp>
#include <acs/openstream/EOpenStreamErrorCode.hpp>
#include <acs/openstream/EStopTarget.hpp>

#include <optional>
#include <string>
#include <variant>

namespace ACS::OpenStream
{

/// The answer to HANDSHAKE.
struct HandshakeAck
{
    bool bOk = true;     ///< False: the server has refused the client.
    std::string version; ///< "MAJOR.MINOR.PATCH"; empty if the server sent none.

    bool operator==(const HandshakeAck&) const = default;
};

/// The MONITOR is accepted; data lines follow.
struct MonitorAck
{
    bool operator==(const MonitorAck&) const = default;
};

/// One sample of a MONITOR.
struct DataLine
{
    double ts = 0.0;                      ///< Milliseconds on a clock of the server; only differences are meaningful.
    double serviceDurationMs = 0.0;       ///< Duration of the GET at the server.
    std::optional<Core::JsonText> result; ///< The body of the GET.
    std::optional<int> status;            ///< HTTP status if there was no body or no success.
    std::optional<Core::JsonText> id;     ///< Of the MONITOR.

    bool operator==(const DataLine&) const = default;
};

/// The answer to STOP.
struct StopAck
{
    EStopTarget target = EStopTarget::Monitor; ///< As in the request.

    bool operator==(const StopAck&) const = default;
};

/// The service refused a CONTROL (`control_err`). The line does not identify it.
struct ControlError
{
    int status = 0;                     ///< HTTP.
    std::optional<Core::JsonText> body; ///< Of the answer of the service; absent: none.

    bool operator==(const ControlError&) const = default;
};

/// A command is invalid, or the session ends (`error`). The line does not identify the command.
struct ErrorLine
{
    EOpenStreamErrorCode code = EOpenStreamErrorCode::Unknown; ///< Unknown: see codeText.
    std::string codeText;                                      ///< As received; not used for encoding.
    std::string message;                                       ///< For the operator.
    std::string hint;                                          ///< Omitted if empty.

    bool operator==(const ErrorLine&) const = default;
};

/// All lines of a server.
using OpenStreamLine = std::variant<HandshakeAck, MonitorAck, DataLine, StopAck, ControlError, ErrorLine>;

} // namespace ACS::OpenStream
