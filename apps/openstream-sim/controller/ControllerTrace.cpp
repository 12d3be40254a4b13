#include "controller/ControllerTrace.hpp"

#include <fmt/format.h>

#include <functional>
#include <utility>

namespace ACS::OpenStreamSim
{

namespace
{

std::string JoinTraceText(std::string head, std::string_view body)
{
    if (!body.empty())
    {
        head += ' ';
        head += body;
    }
    return head;
}

} // namespace

ControllerTrace::ControllerTrace(Apps::SimulatorTrace& trace, std::uint64_t controller, std::string robotID)
    : _trace(trace),
      _controller(controller),
      _robotID(std::move(robotID))
{
}

void ControllerTrace::OnReceived(std::uint64_t connection, std::string_view bytes)
{
    _connections[connection].received.Add(bytes, std::bind_front(&ControllerTrace::WriteLine, this, true, connection));
}

void ControllerTrace::OnSent(std::uint64_t connection, std::string_view bytes)
{
    _connections[connection].sent.Add(bytes, std::bind_front(&ControllerTrace::WriteLine, this, false, connection));
}

void ControllerTrace::OnClosed(std::uint64_t connection)
{
    if (const auto lines = _connections.find(connection); lines != _connections.end())
    {
        lines->second.received.Finish(std::bind_front(&ControllerTrace::WriteLine, this, true, connection));
        lines->second.sent.Finish(std::bind_front(&ControllerTrace::WriteLine, this, false, connection));
        _connections.erase(lines);
    }
}

void ControllerTrace::OnRequest(const Apps::HttpRequest& request)
{
    const std::string text = MakeTraceText(request);
    Write({"http", true, text});
}

void ControllerTrace::OnAnswer(const Apps::HttpResponse& response)
{
    const std::string text = MakeTraceText(response);
    Write({"http", false, text});
}

void ControllerTrace::WriteLine(bool bIn, std::uint64_t connection, std::string_view text)
{
    Apps::TraceLine line{"arm", bIn, text};
    line.connection = connection;
    Write(line);
}

void ControllerTrace::Write(Apps::TraceLine line)
{
    line.robotID = _robotID;
    line.controller = _controller;
    _trace.Write(line);
}

std::string MakeTraceText(const Apps::HttpRequest& request)
{
    return JoinTraceText(fmt::format("{} {}", request.method, request.target), request.body);
}

std::string MakeTraceText(const Apps::HttpResponse& response)
{
    return JoinTraceText(fmt::to_string(response.status), response.body);
}

} // namespace ACS::OpenStreamSim
