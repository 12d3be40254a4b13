#pragma once

#include <acs/acsd/LineClientOptions.hpp>
#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// Totals of a LineClient since its creation.
struct LineClientStats
{
    std::uint64_t connects = 0;      ///< Connections that were opened.
    std::uint64_t linesReceived = 0; ///< Valid lines, passed to onLine.
    std::uint64_t linesSent = 0;     ///< Passed to the system.
    std::uint64_t linesDropped = 0;  ///< Waiting when a connection was lost, or refused by Send.
};

/// What LineClient::Send did with a line.
enum class ELineSend : std::uint8_t
{
    Accepted,     ///< It is sent, unless the connection is lost first.
    NotConnected, ///< It was dropped.
    QueueFull,    ///< It was dropped; the connection is closed, because the peer does not read.
    InvalidLine,  ///< It was dropped: longer than the limit, or with a line end.
};

/// A TCP client that exchanges lines (UTF-8, ended by LF or CR LF) and reconnects with backoff until it is stopped. A line that is too
/// long, is not valid UTF-8 or has a control character other than a tab ends the connection. The handlers are called on the
/// executor's thread, never from within a call of the client; they may call the client. Used on that thread only.
class ACS_API LineClient final
{
public:
    /// What the client reports. None of the handlers may be empty.
    struct Handlers
    {
        std::function<void()> onConnected; ///< A connection is open.
        std::function<void(std::string_view line)>
            onLine; ///< A line without its end. The view is valid during the call only.
        /// Once for each onConnected unless stopped, and for each attempt to connect that failed.
        std::function<void(std::string_view reason)> onLost;
    };

    /// A connection that has received a line after this time ends an outage: the delays between attempts begin again.
    static constexpr std::chrono::seconds STABLE_AFTER{5};

private:
    class ACS_HIDDEN Impl;

    std::shared_ptr<Impl> _impl;

public:
    /// The random source must outlive the client.
    LineClient(
        const boost::asio::any_io_executor& executor,
        Core::IRandom& random,
        LineClientOptions options,
        Handlers handlers);
    LineClient(const LineClient&) = delete;
    LineClient& operator=(const LineClient&) = delete;
    ~LineClient();

    /// Connects, and reconnects until Stop. Call it once.
    void Start();

    /// Closes the connection and drops the lines that wait. No handler is called any more.
    void Stop();

    /// Sends the line, which has no line end.
    [[nodiscard]] ELineSend Send(std::string line);

    /// Whether a line can be sent now.
    [[nodiscard]] bool IsConnected() const noexcept;
    /// Totals since the client was created.
    [[nodiscard]] const LineClientStats& GetStats() const noexcept;
};

} // namespace ACS::Acsd
