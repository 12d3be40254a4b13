#pragma once

#include <acs/core/Api.hpp>
#include <acs/openstream_asio/OpenStreamClient.hpp>

#include <memory>

namespace ACS::Acsd
{

/// Open Stream (the robot controllers Hi6), as one robot uses it. Called on the executor's thread only.
class ACS_API IOpenStreamService
{
public:
    IOpenStreamService() = default;
    IOpenStreamService(const IOpenStreamService&) = delete;
    IOpenStreamService& operator=(const IOpenStreamService&) = delete;
    virtual ~IOpenStreamService() = default;

    /// Makes a client on the executor of the robot. It logs, and writes what it sends and receives to the trace of acsd; the
    /// functions of the options are called as well. The robot owns it: starts it in IRobot::Start and stops it in IRobot::Stop.
    [[nodiscard]] virtual std::unique_ptr<OpenStreamAsio::OpenStreamClient> MakeClient(
        OpenStreamAsio::OpenStreamClientOptions options,
        OpenStreamAsio::OpenStreamClient::EventHandler handler) = 0;
};

} // namespace ACS::Acsd
