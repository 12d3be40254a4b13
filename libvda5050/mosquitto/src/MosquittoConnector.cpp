#include "MosquittoConnector.hpp"

#include <boost/asio/execution/outstanding_work.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/prefer.hpp>
#include <mosquitto.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <mqtt_protocol.h>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

const char* GetTextOrNull(const std::string& text)
{
    return text.empty() ? nullptr : text.c_str();
}

/// An encrypted key fails to load. Without this function OpenSSL would ask at the terminal and wait for a person.
int RefusePassphrase(char* /*buffer*/, int /*size*/, int /*rwflag*/, void* /*userdata*/)
{
    return -1;
}

int ConfigureTLS(mosquitto* client, const MosquittoTLS& tls)
{
    if (tls.caFile.empty())
    {
        const int code = mosquitto_int_option(client, MOSQ_OPT_TLS_USE_OS_CERTS, 1);
        if (code != MOSQ_ERR_SUCCESS)
        {
            return code;
        }
    }
    return mosquitto_tls_set(
        client,
        GetTextOrNull(tls.caFile),
        nullptr,
        GetTextOrNull(tls.certFile),
        GetTextOrNull(tls.keyFile),
        &RefusePassphrase);
}

int Configure(mosquitto* client, const MosquittoOptions& options)
{
    int code = mosquitto_int_option(client, MOSQ_OPT_TCP_NODELAY, 1);
    if (code == MOSQ_ERR_SUCCESS)
    {
        const int version = options.version == EMqttVersion::Version5 ? MQTT_PROTOCOL_V5 : MQTT_PROTOCOL_V311;
        code = mosquitto_int_option(client, MOSQ_OPT_PROTOCOL_VERSION, version);
    }
    if (code == MOSQ_ERR_SUCCESS && !options.username.empty())
    {
        code = mosquitto_username_pw_set(client, options.username.c_str(), GetTextOrNull(options.password));
    }
    if (code == MOSQ_ERR_SUCCESS && options.tls.has_value())
    {
        code = ConfigureTLS(client, *options.tls);
    }
    if (code == MOSQ_ERR_SUCCESS && options.will.has_value())
    {
        const MqttMessage& will = options.will->message;
        code = mosquitto_will_set(
            client,
            will.topic.c_str(),
            static_cast<int>(will.payload.size()),
            will.payload.data(),
            std::min(will.qos, options.maxQos),
            will.bRetained);
    }
    return code;
}

int Connect(mosquitto* client, const MosquittoOptions& options)
{
    mosquitto_property* properties = nullptr;
    int code = MOSQ_ERR_SUCCESS;
    if (options.version == EMqttVersion::Version5 && !options.bCleanSession)
    {
        const auto expiry = static_cast<std::uint32_t>(options.sessionExpiry.count());
        code = mosquitto_property_add_int32(&properties, MQTT_PROP_SESSION_EXPIRY_INTERVAL, expiry);
    }
    const auto keepAlive = static_cast<int>(options.keepAlive.count());
    const char* const host = options.host.c_str();
    errno = 0;
    if (code == MOSQ_ERR_SUCCESS && options.host == "localhost")
    {
        // The blocking form tries ::1 and 127.0.0.1.
        code = mosquitto_connect_bind_v5(client, host, options.port, keepAlive, nullptr, properties);
    }
    else if (code == MOSQ_ERR_SUCCESS)
    {
        if (properties != nullptr)
        {
            // Only the blocking form takes properties. Without a host it keeps them for the next connect, and fails.
            mosquitto_connect_bind_v5(client, nullptr, 0, 0, nullptr, properties);
        }
        errno = 0;
        code = mosquitto_connect_async(client, host, options.port, keepAlive);
    }
    mosquitto_property_free_all(&properties);
    return code;
}

/// libmosquitto initialises its use of OpenSSL at the first connection with TLS, and not for several threads: until one has
/// connected, the others wait.
class FirstTLS
{
    std::mutex _mutex;
    bool _bInitialised = false;

public:
    [[nodiscard]] int Connect(mosquitto* client, const MosquittoOptions& options)
    {
        std::unique_lock lock(_mutex);
        if (_bInitialised)
        {
            lock.unlock();
            return VDA5050::Connect(client, options);
        }
        const int code = VDA5050::Connect(client, options);
        _bInitialised = code == MOSQ_ERR_SUCCESS;
        return code;
    }
};

int ConnectInTurn(mosquitto* client, const MosquittoOptions& options)
{
    static FirstTLS firstTLS;
    return options.tls.has_value() ? firstTLS.Connect(client, options) : Connect(client, options);
}

/// Signals are for the thread of the event loop.
void BlockSignals()
{
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);
}

} // namespace

/// Shared with the thread, which can outlive the connector.
struct MosquittoConnector::Task : public std::enable_shared_from_this<Task>
{
    MosquittoOptions options;
    Outcome outcome;
    Handler handler;
    MosquittoConnector* ownerOrNull = nullptr; ///< On the executor only.
    std::mutex mutex;
    /// Keeps the loop running while the thread is under way; empty after Abandon. Under the mutex.
    std::optional<boost::asio::any_io_executor> executorOrNull;

    void Run()
    {
        BlockSignals();
        mosquitto* const client = outcome.clientOrNull->GetHandleOrNull();
        errno = 0;
        outcome.code = Configure(client, options);
        if (outcome.code == MOSQ_ERR_SUCCESS)
        {
            outcome.code = ConnectInTurn(client, options);
        }
        outcome.systemError = errno;
        Finish();
    }

    void Finish()
    {
        const std::lock_guard lock(mutex);
        if (executorOrNull.has_value())
        {
            boost::asio::post(*executorOrNull, [self = shared_from_this()]() {
                if (self->ownerOrNull != nullptr)
                {
                    self->ownerOrNull->OnFinished();
                }
            });
            executorOrNull.reset();
        }
    }
};

MosquittoConnector::MosquittoConnector(const boost::asio::any_io_executor& executor)
    : _executor(executor)
{
}

MosquittoConnector::~MosquittoConnector()
{
    Abandon();
}

bool MosquittoConnector::IsBusy() const noexcept
{
    return _taskOrNull != nullptr;
}

void MosquittoConnector::ConnectAsync(MosquittoClient client, const MosquittoOptions& options, Handler handler)
{
    assert(!IsBusy());
    _lateOrNull.reset();
    _taskOrNull = std::make_shared<Task>();
    _taskOrNull->options = options;
    _taskOrNull->outcome.clientOrNull = std::move(client);
    _taskOrNull->handler = std::move(handler);
    _taskOrNull->ownerOrNull = this;
    _taskOrNull->executorOrNull = boost::asio::prefer(_executor, boost::asio::execution::outstanding_work_t::tracked);
    try
    {
        std::thread([task = _taskOrNull] { task->Run(); }).detach();
    }
    catch (const std::system_error& error)
    {
        _taskOrNull->outcome.code = MOSQ_ERR_ERRNO;
        _taskOrNull->outcome.systemError = error.code().value();
        _taskOrNull->Finish();
    }
}

std::optional<MosquittoClient> MosquittoConnector::TakeLateOrNull()
{
    return std::exchange(_lateOrNull, std::nullopt);
}

void MosquittoConnector::Abandon() noexcept
{
    if (_taskOrNull != nullptr)
    {
        _taskOrNull->ownerOrNull = nullptr;
        const std::lock_guard lock(_taskOrNull->mutex);
        _taskOrNull->executorOrNull.reset();
    }
    _taskOrNull.reset();
}

void MosquittoConnector::OnFinished()
{
    const std::shared_ptr<Task> task = std::exchange(_taskOrNull, nullptr);
    {
        // The thread uses the executor until it unlocks; the loop may be destroyed after this call.
        const std::lock_guard lock(task->mutex);
    }
    task->handler(task->outcome);
    std::optional<MosquittoClient> leftOrNull = std::exchange(task->outcome.clientOrNull, std::nullopt);
    if (!task->options.bCleanSession)
    {
        _lateOrNull = std::move(leftOrNull);
    }
}

} // namespace ACS::VDA5050
