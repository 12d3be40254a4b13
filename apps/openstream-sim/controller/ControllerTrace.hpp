#pragma once

#include "common/http/HttpMessage.hpp"
#include "common/trace/LineCollector.hpp"
#include "common/trace/SimulatorTrace.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace ACS::OpenStreamSim
{

/// Writes what one controller receives and sends to the trace of the program: the lines of its Open Stream, and the requests and
/// answers of its HTTP Open API.
class ControllerTrace final
{
    struct Lines
    {
        Apps::LineCollector received;
        Apps::LineCollector sent;
    };

    Apps::SimulatorTrace& _trace;
    std::uint64_t _controller;
    std::string _robotID;
    std::map<std::uint64_t, Lines> _connections; ///< The open ones of the Open Stream, which the server limits.

public:
    /// The trace outlives it. The robot is empty if the controller has none.
    ControllerTrace(Apps::SimulatorTrace& trace, std::uint64_t controller, std::string robotID);

    void OnReceived(std::uint64_t connection, std::string_view bytes);
    void OnSent(std::uint64_t connection, std::string_view bytes);
    /// The connection is closed: what arrived of an incomplete line is a line.
    void OnClosed(std::uint64_t connection);

    void OnRequest(const Apps::HttpRequest& request);
    void OnAnswer(const Apps::HttpResponse& response);

private:
    void WriteLine(bool bIn, std::uint64_t connection, std::string_view text);
    /// The robot and the controller are added.
    void Write(Apps::TraceLine line);
};

/// "POST /project/robot/start {"val":1}": method, target and body.
[[nodiscard]] std::string MakeTraceText(const Apps::HttpRequest& request);
/// "200 {"val":1}": status and body.
[[nodiscard]] std::string MakeTraceText(const Apps::HttpResponse& response);

} // namespace ACS::OpenStreamSim
