#pragma once

#include "trace/MessageTrace.hpp"
#include <acs/acsd/IOpenStreamService.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <memory>
#include <string>

namespace ACS::Acsd
{

/// Makes the Open Stream clients of one robot.
class OpenStreamService final : public IOpenStreamService
{
public:
    /// All of these must outlive the clients.
    struct Dependencies
    {
        boost::asio::any_io_executor executor;
        Core::IClock& clock;
        Core::IRandom& random;
        Core::Logger logger;
        MessageTrace* traceOrNull = nullptr;
        std::function<bool()> mayCommand{}; ///< Asked before each message; empty: it may be sent.
    };

private:
    Dependencies _dependencies;
    const std::string _robotID;

public:
    OpenStreamService(Dependencies dependencies, std::string robotID);

    [[nodiscard]] std::unique_ptr<OpenStreamAsio::OpenStreamClient> MakeClient(
        OpenStreamAsio::OpenStreamClientOptions options,
        OpenStreamAsio::OpenStreamClient::EventHandler handler) override;
};

} // namespace ACS::Acsd
