#pragma once

#include "IMosquittoConnectionOwner.hpp"
#include "MosquittoClient.hpp"
#include "MosquittoConnector.hpp"
#include <acs/core/Result.hpp>
#include <acs/vda5050/IMqttLink.hpp>
#include <acs/vda5050_mosquitto/MosquittoOptions.hpp>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <variant>
#include <vector>

struct mosquitto;
struct mosquitto_message;

namespace ACS::VDA5050
{

/// One connection, from CONNECT to its end. With a clean session it has a libmosquitto client of its own, so that nothing
/// of the attempt before (unacknowledged messages, an old will) leaks into it; a persistent session hands its client on
/// from one connection to the next. Its socket is watched by the executor.
class MosquittoConnection final : public std::enable_shared_from_this<MosquittoConnection>
{
    struct Up
    {
    };
    struct Sent
    {
        int messageID = 0;
    };
    struct Subscribed
    {
        int messageID = 0;
        bool bGranted = false;
    };
    struct Closed
    {
        std::error_code reason;
    };
    struct TooLong
    {
        std::string topic;
        std::size_t bytes = 0;
    };
    using Event = std::variant<Up, MqttMessage, TooLong, Sent, Subscribed, Closed>;

    enum class EState : std::uint8_t
    {
        Connecting,
        Up,
        Closed
    };

    /// What the next connection of a persistent session does with the client.
    enum class EClientUse : std::uint8_t
    {
        Kept,
        Renewed,  ///< It cannot be used any more, and nothing is in flight: the connection ends for another client.
        Forgotten ///< The broker has forgotten its session.
    };

    /// Of MosquittoOptions.
    struct Limits
    {
        std::size_t maxUnsent = 0;
        std::size_t maxPayloadBytes = 0;
        std::chrono::milliseconds connectTimeout{};
        std::uint8_t maxQos = 0;
    };

    boost::asio::any_io_executor _executor;
    IMosquittoConnectionOwner* _ownerOrNull;
    std::optional<MosquittoClient> _client;
    boost::asio::posix::stream_descriptor _socket;
    boost::asio::steady_timer _houseKeeping;
    boost::asio::steady_timer _connectTimer;
    std::vector<Event> _events;
    std::size_t _unsent = 0; ///< Of QoS 0.
    Limits _limits;
    std::function<bool()> _maySend; ///< MosquittoOptions::maySend
    int _closeCode = 0;             ///< Of libmosquitto.
    EState _state = EState::Connecting;
    EClientUse _clientUse = EClientUse::Kept;
    bool _bPersistent = false;
    bool _bContinued = false; ///< With the client of the previous connection.
    bool _bWaitsToWrite = false;
    bool _bDispatchPosted = false;

public:
    MosquittoConnection(const boost::asio::any_io_executor& executor, IMosquittoConnectionOwner& owner);

    /// Begins, with the client that a connection before has left or with a new one; an error means that nothing will follow.
    /// The connector is not busy.
    [[nodiscard]] std::error_code Open(
        const MosquittoOptions& options,
        std::optional<MosquittoClient> clientOrNull,
        MosquittoConnector& connector);
    /// After the end: the client for the next connection of a persistent session.
    [[nodiscard]] std::optional<MosquittoClient> TakeClientOrNull();
    /// After the end: whether the next connection needs a new client, also because the broker has forgotten the session.
    [[nodiscard]] bool IsRenewal() const;

    /// The id of the message, with which OnSent comes. Fails with not_connected, QueueFull, or an error of libmosquitto.
    [[nodiscard]] Core::Result<int> Publish(const MqttMessage& message);
    /// The id with which OnSubscribed comes; nothing without a connection, or if the filter is invalid.
    [[nodiscard]] std::optional<int> SubscribeOrNull(const MqttSubscription& subscription);
    /// Without an answer. Does nothing where there is no connection.
    void Unsubscribe(const std::string& topicFilter);
    /// The broker has confirmed one more subscription: the time to connect starts again.
    void ProlongConnect();
    /// The owner has all that it waited for: the time to connect is no longer counted.
    void Confirm();
    /// Ends with OnConnectionClosed; the broker sends no will.
    void Disconnect();
    /// Ends at once; the owner is not called any more.
    void Abandon();

    [[nodiscard]] bool IsUp() const;
    /// Whether a message waits for the socket or for the broker's acknowledgement.
    [[nodiscard]] bool HasUnsent() const;

private:
    [[nodiscard]] bool IsClosed() const noexcept;
    /// Takes the client, whose connect has begun or failed.
    void OnConnecting(MosquittoConnector::Outcome& outcome);
    void SetCallbacks();
    void WaitToRead();
    void WaitToWrite();
    void WaitForHouseKeeping();
    [[nodiscard]] bool TryPermit();
    void ReadAll();
    /// After each call of libmosquitto: closes after an error, writes what it has queued, and dispatches events.
    void FinishCall(int code, int systemError);
    void Close(std::error_code reason);
    void CloseSocket();
    void PostDispatch();
    void Dispatch();
    void Notify(const Event& event);

    void RenewWhenSpoilt();
    /// Null while the connector has the client, and after TakeClientOrNull.
    [[nodiscard]] mosquitto* GetClientOrNull() const;

    void HandleConnect(int returnCode, bool bSessionPresent);
    void HandleMessage(const mosquitto_message& message);
    void HandleSent(int messageID);
};

} // namespace ACS::VDA5050
