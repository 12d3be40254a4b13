#include "common/config/DurationText.hpp"
#include <acs/acsd/LineRobot.hpp>
#include <acs/acsd/LineRobotSetup.hpp>

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace ACS::Acsd
{

LineRobotSetup::LineRobotSetup(RobotCapabilities capabilities, LineClientOptions options, AdapterMaker makeAdapter)
    : _capabilities(std::move(capabilities)),
      _options(std::move(options)),
      _makeAdapter(std::move(makeAdapter))
{
    if (_capabilities.connectionHint.empty())
    {
        _capabilities.connectionHint = fmt::format("It is expected at {}:{}.", _options.host, _options.port);
    }
}

RobotCapabilities LineRobotSetup::GetCapabilities() const
{
    return _capabilities;
}

std::unique_ptr<IRobot> LineRobotSetup::MakeRobot(RobotServices services) const
{
    return std::make_unique<LineRobot>(std::move(services), _options, _makeAdapter());
}

LineClientOptions ReadLineOptions(const OptionTable& options)
{
    constexpr std::chrono::milliseconds SHORTEST_TIMEOUT{100};
    constexpr std::chrono::seconds DEFAULT_TIMEOUT{5};
    LineClientOptions read;
    TcpAddress address = options.GetTcpAddress("url");
    read.host = std::move(address.host);
    read.port = address.port;
    read.receiveTimeout =
        options.GetDuration("receive_timeout", std::chrono::milliseconds(0), std::chrono::hours(1), DEFAULT_TIMEOUT);
    if (read.receiveTimeout.count() > 0 && read.receiveTimeout < SHORTEST_TIMEOUT)
    {
        options.AddError(
            "receive_timeout",
            fmt::format(
                "expected '0s' or a duration from '100ms' to '1h', found '{}'",
                Apps::MakeDurationText(read.receiveTimeout)));
    }
    return read;
}

} // namespace ACS::Acsd
