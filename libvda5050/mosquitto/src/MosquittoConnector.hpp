#pragma once

#include "MosquittoClient.hpp"
#include <acs/vda5050_mosquitto/MosquittoOptions.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <functional>
#include <memory>
#include <optional>

namespace ACS::VDA5050
{

/// Configures and connects clients of libmosquitto on a thread of their own, one after the other: reading certificates,
/// resolving the name and connect() can take seconds or, on a name server that does not answer, longer. Meanwhile the client
/// belongs to that thread. Used on the executor's thread.
class MosquittoConnector final
{
public:
    struct Outcome
    {
        std::optional<MosquittoClient> clientOrNull; ///< Never empty at first.
        int code = 0;                                ///< Of libmosquitto.
        int systemError = 0;                         ///< errno, for MOSQ_ERR_ERRNO.
    };

    /// Called on the executor. Takes the client if it is still wanted; does not destroy the connector.
    using Handler = std::function<void(Outcome& outcome)>;

private:
    struct Task;

    boost::asio::any_io_executor _executor;
    std::shared_ptr<Task> _taskOrNull; ///< While its thread runs.
    std::optional<MosquittoClient> _lateOrNull;

public:
    explicit MosquittoConnector(const boost::asio::any_io_executor& executor);
    MosquittoConnector(const MosquittoConnector&) = delete;
    MosquittoConnector& operator=(const MosquittoConnector&) = delete;
    ~MosquittoConnector();

    [[nodiscard]] bool IsBusy() const noexcept;
    /// Only when it is not busy.
    void ConnectAsync(MosquittoClient client, const MosquittoOptions& options, Handler handler);
    /// The client that came too late for its handler: the next attempt of a persistent session continues with it.
    [[nodiscard]] std::optional<MosquittoClient> TakeLateOrNull();
    /// The handler is not called any more; a client that is being connected goes with its thread.
    void Abandon() noexcept;

private:
    void OnFinished();
};

} // namespace ACS::VDA5050
