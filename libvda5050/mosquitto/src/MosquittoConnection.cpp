#include "MosquittoConnection.hpp"

#include "DescriptorDuplicate.hpp"
#include "MosquittoError.hpp"
#include <acs/core/Overloaded.hpp>

#include <boost/asio/post.hpp>
#include <mosquitto.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <mqtt_protocol.h>
#include <span>
#include <tuple>
#include <utility>

namespace ACS::VDA5050
{
namespace
{

constexpr int SUBSCRIPTION_REFUSED = 0x80; ///< And above: the reasons of MQTT 5.
constexpr int EXACTLY_ONCE = 2;

/// libmosquitto's own state, once for the process.
class LibraryUse
{
public:
    LibraryUse()
    {
        mosquitto_lib_init();
    }
    LibraryUse(const LibraryUse&) = delete;
    LibraryUse& operator=(const LibraryUse&) = delete;
    ~LibraryUse()
    {
        mosquitto_lib_cleanup();
    }
};

} // namespace

MosquittoConnection::MosquittoConnection(const boost::asio::any_io_executor& executor, IMosquittoConnectionOwner& owner)
    : _executor(executor),
      _ownerOrNull(&owner),
      _socket(executor),
      _houseKeeping(executor),
      _connectTimer(executor)
{
    static const LibraryUse LIBRARY_USE;
}

mosquitto* MosquittoConnection::GetClientOrNull() const
{
    return _client.has_value() ? _client->GetHandleOrNull() : nullptr;
}

std::error_code MosquittoConnection::Open(
    const MosquittoOptions& options,
    std::optional<MosquittoClient> clientOrNull,
    MosquittoConnector& connector)
{
    _maySend = options.maySend;
    if (_maySend && !_maySend())
    {
        return std::make_error_code(std::errc::operation_not_permitted);
    }
    _bPersistent = !options.bCleanSession;
    _bContinued = clientOrNull.has_value();
    if (!_bContinued)
    {
        const char* const idOrNull = options.clientID.empty() ? nullptr : options.clientID.c_str();
        errno = 0;
        mosquitto* const made = mosquitto_new(idOrNull, options.bCleanSession, nullptr);
        if (made == nullptr)
        {
            return MakeMosquittoError(MOSQ_ERR_ERRNO, errno);
        }
        clientOrNull.emplace(made);
    }
    _limits = {options.maxUnsent, options.maxPayloadBytes, options.connectTimeout, options.maxQos};
    ProlongConnect();
    connector.ConnectAsync(
        std::move(*clientOrNull),
        options,
        [weak = weak_from_this()](MosquittoConnector::Outcome& outcome) {
            const std::shared_ptr<MosquittoConnection> self = weak.lock();
            if (self != nullptr && !self->IsClosed())
            {
                self->OnConnecting(outcome);
            }
        });
    return {};
}

void MosquittoConnection::OnConnecting(MosquittoConnector::Outcome& outcome)
{
    _client = std::exchange(outcome.clientOrNull, std::nullopt);
    mosquitto_user_data_set(GetClientOrNull(), this);
    SetCallbacks();
    if (outcome.code != MOSQ_ERR_SUCCESS)
    {
        Close(MakeMosquittoError(outcome.code, outcome.systemError));
        return;
    }
    // A duplicate, because libmosquitto closes its own descriptor whenever it likes.
    if (const std::error_code refused = AssignDuplicate(_socket, mosquitto_socket(GetClientOrNull())))
    {
        Close(refused);
        return;
    }
    WaitToRead();
    WaitForHouseKeeping();
    FinishCall(MOSQ_ERR_SUCCESS, 0);
}

void MosquittoConnection::SetCallbacks()
{
    mosquitto* const client = GetClientOrNull();
    mosquitto_connect_with_flags_callback_set(client, [](mosquitto*, void* self, int returnCode, int flags) {
        constexpr unsigned SESSION_PRESENT = 1;
        const bool bPresent = (static_cast<unsigned>(flags) & SESSION_PRESENT) != 0;
        static_cast<MosquittoConnection*>(self)->HandleConnect(returnCode, bPresent);
    });
    if (_bPersistent)
    {
        mosquitto_log_callback_set(client, [](mosquitto*, void* self, int, const char* line) {
            const std::optional<ReceivedPublish> publish = ReadPublishLineOrNull(line);
            if (self != nullptr && publish.has_value() && publish->qos == EXACTLY_ONCE)
            {
                static_cast<MosquittoConnection*>(self)->_client->OnPublishCame(publish->messageID);
            }
        });
    }
    mosquitto_disconnect_callback_set(client, [](mosquitto*, void* self, int code) {
        if (self != nullptr) // else while it is connected by its own thread
        {
            static_cast<MosquittoConnection*>(self)->_closeCode = code;
        }
    });
    mosquitto_message_callback_set(client, [](mosquitto*, void* self, const mosquitto_message* message) {
        static_cast<MosquittoConnection*>(self)->HandleMessage(*message);
    });
    mosquitto_publish_callback_set(client, [](mosquitto*, void* self, int messageID) {
        static_cast<MosquittoConnection*>(self)->HandleSent(messageID);
    });
    mosquitto_subscribe_callback_set(
        client,
        [](mosquitto*, void* self, int messageID, int count, const int* grantedOrNull) {
            const std::span<const int> granted(grantedOrNull, static_cast<std::size_t>(count));
            const bool bGranted = std::ranges::none_of(granted, [](int code) { return code >= SUBSCRIPTION_REFUSED; });
            static_cast<MosquittoConnection*>(self)->_events.emplace_back(Subscribed{messageID, bGranted});
        });
}

void MosquittoConnection::HandleConnect(int returnCode, bool bSessionPresent)
{
    if (IsClosed())
    {
        return;
    }
    if (returnCode != 0)
    {
        Close(MakeConnackError(returnCode));
        return;
    }
    if (_bContinued && !bSessionPresent && !(_client->IsQuiet() && !_client->IsSpoilt()))
    {
        // The packet ids of the one side mean nothing to the other any more. Leaving comes before what libmosquitto
        // would send again as soon as this call is over.
        _clientUse = EClientUse::Forgotten;
        mosquitto_disconnect(GetClientOrNull());
        Close({});
        return;
    }
    _state = EState::Up;
    _events.emplace_back(Up{});
}

void MosquittoConnection::HandleMessage(const mosquitto_message& message)
{
    if (message.qos == EXACTLY_ONCE)
    {
        _client->OnReleased(message.mid);
    }
    const auto length = static_cast<std::size_t>(message.payloadlen);
    if (length > _limits.maxPayloadBytes)
    {
        _events.emplace_back(TooLong{message.topic, length});
        return;
    }
    MqttMessage copy;
    copy.topic = message.topic;
    copy.payload.assign(static_cast<const char*>(message.payload), length);
    copy.qos = static_cast<std::uint8_t>(message.qos);
    copy.bRetained = message.retain;
    _events.emplace_back(std::move(copy));
}

void MosquittoConnection::HandleSent(int messageID)
{
    if (!_client->TryAcknowledge(messageID) && _unsent > 0)
    {
        --_unsent;
    }
    _events.emplace_back(Sent{messageID});
}

Core::Result<int> MosquittoConnection::Publish(const MqttMessage& message)
{
    if (!IsUp() || !TryPermit())
    {
        return Core::Fail(std::make_error_code(std::errc::not_connected));
    }
    if (_unsent + _client->CountUnacknowledged() >= _limits.maxUnsent)
    {
        return Core::Fail(Core::ECoreError::QueueFull, message.topic);
    }
    int messageID = 0;
    const std::uint8_t qos = std::min(message.qos, _limits.maxQos);
    const std::size_t ofQosZero = qos == 0 ? 1U : 0U;
    _unsent += ofQosZero; // before the call, which may report such a message as sent
    errno = 0;
    const int code = mosquitto_publish(
        GetClientOrNull(),
        &messageID,
        message.topic.c_str(),
        static_cast<int>(message.payload.size()),
        message.payload.data(),
        qos,
        message.bRetained);
    if (code != MOSQ_ERR_SUCCESS)
    {
        // A broken socket shows itself to the waiting read; here the message is merely not sent.
        _unsent -= std::min(_unsent, ofQosZero);
        return Core::Fail(MakeMosquittoError(code, errno), message.topic);
    }
    if (qos != 0)
    {
        _client->OnSending(messageID);
    }
    FinishCall(MOSQ_ERR_SUCCESS, 0);
    return messageID;
}

std::optional<int> MosquittoConnection::SubscribeOrNull(const MqttSubscription& subscription)
{
    const int qos = std::min(subscription.qos, _limits.maxQos);
    int messageID = 0;
    if (!IsUp()
        || mosquitto_subscribe(GetClientOrNull(), &messageID, subscription.topicFilter.c_str(), qos)
            != MOSQ_ERR_SUCCESS)
    {
        return std::nullopt;
    }
    FinishCall(MOSQ_ERR_SUCCESS, 0);
    return messageID;
}

void MosquittoConnection::Unsubscribe(const std::string& topicFilter)
{
    if (IsUp())
    {
        std::ignore = mosquitto_unsubscribe(GetClientOrNull(), nullptr, topicFilter.c_str());
        FinishCall(MOSQ_ERR_SUCCESS, 0);
    }
}

void MosquittoConnection::ProlongConnect()
{
    _connectTimer.expires_after(_limits.connectTimeout);
    _connectTimer.async_wait([weak = weak_from_this()](const boost::system::error_code& error) {
        const std::shared_ptr<MosquittoConnection> self = weak.lock();
        if (self != nullptr && !error)
        {
            self->Close(std::make_error_code(std::errc::timed_out));
        }
    });
}

void MosquittoConnection::Confirm()
{
    _connectTimer.cancel();
}

void MosquittoConnection::Disconnect()
{
    errno = 0;
    const int code = mosquitto_disconnect(GetClientOrNull());
    FinishCall(code, errno);
}

void MosquittoConnection::Abandon()
{
    _ownerOrNull = nullptr;
    _events.clear();
    Close({});
}

bool MosquittoConnection::IsUp() const
{
    return _state == EState::Up;
}

bool MosquittoConnection::IsClosed() const noexcept
{
    return _state == EState::Closed;
}

bool MosquittoConnection::HasUnsent() const
{
    return _unsent > 0 || (_client.has_value() && _client->CountUnacknowledged() > 0);
}

void MosquittoConnection::Close(std::error_code reason)
{
    if (std::exchange(_state, EState::Closed) == EState::Closed)
    {
        return;
    }
    _events.emplace_back(Closed{reason});
    CloseSocket();
    PostDispatch();
}

std::optional<MosquittoClient> MosquittoConnection::TakeClientOrNull()
{
    const bool bKept = _client.has_value() && _bPersistent && _clientUse != EClientUse::Forgotten
        && !(_client->IsSpoilt() && _client->IsQuiet());
    if (!bKept)
    {
        return std::nullopt;
    }
    mosquitto_user_data_set(GetClientOrNull(), nullptr);
    return std::exchange(_client, std::nullopt);
}

bool MosquittoConnection::IsRenewal() const
{
    return _clientUse != EClientUse::Kept;
}

void MosquittoConnection::RenewWhenSpoilt()
{
    if (IsUp() && _clientUse == EClientUse::Kept && _ownerOrNull != nullptr && _client->IsSpoilt() && _client->IsQuiet()
        && _events.empty())
    {
        _clientUse = EClientUse::Renewed;
        Disconnect();
    }
}

void MosquittoConnection::PostDispatch()
{
    if (_bDispatchPosted)
    {
        return;
    }
    _bDispatchPosted = true;
    boost::asio::post(_executor, [weak = weak_from_this()]() {
        const std::shared_ptr<MosquittoConnection> self = weak.lock();
        if (self != nullptr)
        {
            self->_bDispatchPosted = false;
            self->Dispatch();
        }
    });
}

void MosquittoConnection::Dispatch()
{
    // What the owner does adds events of its own: those are for the round that FinishCall has posted.
    const std::vector<Event> events = std::exchange(_events, {});
    for (const Event& event : events)
    {
        if (_ownerOrNull == nullptr)
        {
            return;
        }
        Notify(event);
    }
    RenewWhenSpoilt();
}

void MosquittoConnection::Notify(const Event& event)
{
    IMosquittoConnectionOwner& owner = *_ownerOrNull;
    std::visit(
        Core::Overloaded{
            [&owner](const Up&) { owner.OnConnectionUp(); },
            [&owner](const MqttMessage& message) { owner.OnConnectionMessage(message); },
            [&owner](const TooLong& dropped) { owner.OnTooLong(dropped.topic, dropped.bytes); },
            [&owner](const Sent& sent) { owner.OnSent(sent.messageID); },
            [&owner](const Subscribed& answer) { owner.OnSubscribed(answer.messageID, answer.bGranted); },
            [&owner](const Closed& closed) {
                owner.OnConnectionClosed(closed.reason);
            }},
        event);
}

} // namespace ACS::VDA5050
