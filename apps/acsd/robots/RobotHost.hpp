#pragma once

#include "common/http/MetricsEndpoint.hpp"
#include "config/AcsdConfig.hpp"
#include "trace/MessageTrace.hpp"
#include <acs/acsd/IMqttService.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/ClientSessionActions.hpp>
#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/ERobotType.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/RobotEvent.hpp>
#include <acs/vda5050/IMqttLink.hpp>
#include <acs/vda5050/MasterSession.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace ACS::Acsd
{

/// Runs the adapter of one robot: passes messages and timers to it, sends its messages, and passes its events to the engine.
/// Decides nothing. Runs on one thread, the executor's.
class RobotHost final : private VDA5050::IMqttLinkListener
{
public:
    /// Called from within the host's calls and from its timers; may call Handle.
    using EventHandler = std::function<void(const std::string& robotID, const Planning::RobotEvent& event)>;

    /// State and statistics of the robot's links.
    struct Figures
    {
        std::optional<Core::SteadyTime> seenAt; ///< Time of the vehicle's last message.
        VDA5050::MasterStatistics vehicle;
        std::optional<OpenStream::ClientSessionStats> arm; ///< Set after its client has been started.
        bool bArmReady = false;
    };

    /// All of these must outlive the host.
    struct Dependencies
    {
        boost::asio::any_io_executor executor;
        Core::IClock& clock;
        Core::IRandom& random;
        IMqttService& mqtt;
        Core::Logger logger;
        Apps::MetricsEndpoint& metrics;
        MessageTrace* traceOrNull = nullptr;
    };

private:
    struct Impl;

    std::unique_ptr<Impl> _impl;

public:
    RobotHost(Dependencies surroundings, const AcsdConfig& config, const RobotLinkConfig& robot, EventHandler handler);
    RobotHost(const RobotHost&) = delete;
    RobotHost& operator=(const RobotHost&) = delete;
    ~RobotHost() override;

    /// The actions that the robot's adapter rejects.
    [[nodiscard]] static Planning::RejectedActions FindRejectedActions(
        const AcsdConfig& config,
        const RobotLinkConfig& robot,
        Planning::ERobotType type);

    /// Subscribes and connects to the arm.
    void Start();

    /// Closes the session with the arm.
    void Stop();

    void Handle(const Planning::RobotCommand& command);

    [[nodiscard]] const std::string& GetRobotID() const noexcept;
    /// The begin of the vehicle's MQTT topics.
    [[nodiscard]] const std::string& GetTopicPrefix() const noexcept;
    [[nodiscard]] Figures GetFigures() const;
    /// What the vehicle's messages contradict, for the status page.
    [[nodiscard]] std::vector<std::string> GetWarnings() const;

private:
    void OnLinkUp() override;
    void OnLinkDown(std::error_code reason) override;
    void OnMqttMessage(const VDA5050::MqttMessage& message) override;
};

} // namespace ACS::Acsd
