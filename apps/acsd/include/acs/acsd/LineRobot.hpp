#pragma once

#include <acs/acsd/ILineAdapter.hpp>
#include <acs/acsd/IRobot.hpp>
#include <acs/acsd/LineClient.hpp>
#include <acs/acsd/LineClientOptions.hpp>
#include <acs/acsd/RobotServices.hpp>
#include <acs/core/Api.hpp>

#include <memory>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// A robot that speaks lines over TCP: connects a pure ILineAdapter. Metrics: connected, connects_total, lines_received_total,
/// lines_sent_total, lines_dropped_total.
class ACS_API LineRobot final : public IRobot
{
    RobotServices _services;
    std::string _peer; ///< "HOST:PORT"
    std::unique_ptr<ILineAdapter> _adapter;
    LineClient _client;
    bool _bConnected = false;
    bool _bLossLogged = false; ///< Of the current outage, which ends with a line after LineClient::STABLE_AFTER.
    Core::SteadyTime _connectedAt;

public:
    /// The adapter must not be null. Connects after Start.
    LineRobot(RobotServices services, LineClientOptions options, std::unique_ptr<ILineAdapter> adapter);

    [[nodiscard]] Planning::IRobotAdapter& GetAdapter() noexcept override;
    void Start() override;
    void Stop() override;
    void OnAdapterCalled() override;
    void UpdateMetrics() override;

private:
    void OnConnected();
    void OnLine(std::string_view line);
    void OnLost(std::string_view reason);
};

} // namespace ACS::Acsd
