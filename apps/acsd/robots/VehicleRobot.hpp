#pragma once

#include "common/log/LogRateLimiter.hpp"
#include "common/process/TimerSet.hpp"
#include "config/VehicleConfig.hpp"
#include "robots/RetainedCommands.hpp"
#include "robots/RobotAdapterFactory.hpp"
#include "robots/RobotOutputs.hpp"
#include "robots/VehicleWatch.hpp"
#include <acs/acsd/IRobot.hpp>
#include <acs/acsd/IRobotActions.hpp>
#include <acs/acsd/RobotServices.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/ClientSessionActions.hpp>
#include <acs/openstream_asio/OpenStreamClient.hpp>
#include <acs/vda5050/IMqttLink.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace ACS::Acsd
{

/// A VDA5050 vehicle, with an arm or without: passes messages to its adapter, and sends the adapter's messages. Decides nothing.
class VehicleRobot final : public IRobot, private IRobotActions, private VDA5050::IMqttLinkListener
{
    enum class ETimer : std::uint8_t
    {
        Renewal, ///< Of the subscriptions to command topics.
    };

    RobotServices _services;
    const std::shared_ptr<const VehicleConfig> _config;
    RobotOutputs _outputs;
    RobotAdapter _made;
    VehicleWatch _watch;
    RetainedCommands _retained;
    Apps::LogRateLimiter _unsent; ///< A vehicle that reconnects has messages each time.
    Apps::TimerSet<ETimer> _timers;
    std::optional<Core::SteadyTime> _seenAt;                ///< Time of the vehicle's last message.
    std::optional<Core::WallTime> _seenWallAt;              ///< The same time.
    std::unique_ptr<OpenStreamAsio::OpenStreamClient> _arm; ///< Null without an arm.

public:
    /// The services have the broker, the configuration the site.
    VehicleRobot(RobotServices services, std::shared_ptr<const VehicleConfig> config);

    [[nodiscard]] Planning::IRobotAdapter& GetAdapter() noexcept override;
    void Start() override;
    void Stop() override;
    void OnAdapterCalled() override;
    void UpdateMetrics() override;
    [[nodiscard]] DriverDetails GetDetails() const override;
    [[nodiscard]] IRobotActions* GetActionsOrNull() noexcept override;

private:
    [[nodiscard]] std::unique_ptr<OpenStreamAsio::OpenStreamClient> MakeArmOrNull();
    void OnArmEvent(const OpenStream::ClientEvent& event);
    void Publish(const VDA5050::MqttMessage& message);
    void Send(const ArmRequest& request) const;
    void StartRenewal();

    [[nodiscard]] std::vector<RobotActionOffer> ListOffers() const override;
    [[nodiscard]] tl::expected<std::string, RobotActionRefusal> Request(
        const RobotActionRequest& request,
        Core::Now now,
        Planning::AdapterActions& out) override;
    [[nodiscard]] std::vector<RobotActionChange> TakeChanges() override;

    void OnLinkUp() override;
    void OnLinkDown(std::error_code reason) override;
    void OnMqttMessage(const VDA5050::MqttMessage& message) override;
};

} // namespace ACS::Acsd
