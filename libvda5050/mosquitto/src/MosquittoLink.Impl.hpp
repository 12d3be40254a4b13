#pragma once

#include "BrokerConnectors.hpp"
#include "BrokerRotation.hpp"
#include "EarlyMessages.hpp"
#include "LinkLog.hpp"
#include "LinkSubscriptions.hpp"
#include "MosquittoConnection.hpp"
#include "RivalDetector.hpp"
#include <acs/core/Backoff.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace ACS::VDA5050
{

/// Shared, so that a timer or a posted call that comes late finds either the whole of it or nothing.
class MosquittoLink::Impl final : public IMosquittoConnectionOwner, public std::enable_shared_from_this<Impl>
{
    enum class EState : std::uint8_t
    {
        Down, ///< Not started, connecting, or waiting for the next attempt.
        Up,
        Stopping,
        Stopped
    };

    boost::asio::any_io_executor _executor;
    MosquittoOptions _options;
    BrokerRotation _rotation;
    BrokerConnectors _connectors;
    LinkLog _log;
    LinkSubscriptions _subscriptions;
    EarlyMessages _early;
    RivalDetector _rivals;
    IMqttLinkListener* _listenerOrNull;
    Core::IRandom& _random;
    Core::Backoff _backoff;
    boost::asio::steady_timer
        _timer; ///< Until the next attempt, until the backoff is forgotten, or until the end of a stop.
    std::shared_ptr<MosquittoConnection> _connectionOrNull;
    std::optional<MosquittoClient> _clientOrNull; ///< Of a persistent session, between two connections.
    std::vector<StopHandler> _stopHandlers;
    EState _state = EState::Down;

public:
    Impl(
        const boost::asio::any_io_executor& executor,
        Core::IRandom& random,
        Core::Logger logger,
        MosquittoOptions options,
        IMqttLinkListener& listener);

    void Start();
    void Abandon();
    [[nodiscard]] Core::Result<void> Publish(const MqttMessage& message);
    void Subscribe(const std::vector<MqttSubscription>& subscriptions);
    void Unsubscribe(const std::string& topicFilter);
    void SetWill(const MqttWill& will);
    [[nodiscard]] bool IsConnected() const;
    [[nodiscard]] std::size_t GetBrokerIndex() const noexcept;
    void StopAsync(
        const std::optional<MqttMessage>& lastMessageOrNull,
        std::chrono::milliseconds timeout,
        StopHandler handler);

    void OnConnectionUp() override;
    void OnConnectionMessage(const MqttMessage& message) override;
    void OnTooLong(const std::string& topic, std::size_t bytes) override;
    void OnSent(int messageID) override;
    void OnSubscribed(int messageID, bool bGranted) override;
    void OnConnectionClosed(std::error_code reason) override;

private:
    [[nodiscard]] bool IsStopping() const noexcept;
    void Connect();
    [[nodiscard]] bool IsConnectorBusy() const;
    void SendSubscriptions();
    void RefuseSession(const std::string& filter);
    void AnnounceWhenConfirmed();
    void TryNext();
    void Retry(std::chrono::milliseconds pause);
    [[nodiscard]] bool HasRival(const std::error_code& reason);
    void LogEnd(bool bWasUp, bool bRenewal, bool bRival, const std::error_code& reason);
    void FinishStop();
};

} // namespace ACS::VDA5050
