#pragma once

#include "LazyTimer.hpp"
#include "StreamMeter.hpp"
#include <acs/core/Now.hpp>
#include <acs/openstream/ClientSessionActions.hpp>
#include <acs/openstream/OpenStreamRequests.hpp>
#include <acs/openstream/StreamQuality.hpp>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace ACS::OpenStream
{

/// The MONITOR of a ClientSession: brings the server to stream what SetMonitor asks for, and watches the age of the samples.
/// → StartTimer, CancelTimer, ClientMonitorStarted, ClientMonitorRefused, ClientMonitorStale, ClientData.
class ClientMonitor
{
    /// What the server streams, as far as known.
    enum class EStream : std::uint8_t
    {
        Nothing,
        Started,  ///< The MONITOR with _startedNumber.
        Occupied, ///< It answered monitor_already_active: STOP monitor has to precede the MONITOR.
        Freed, ///< Nothing, after that STOP monitor. If it still answers monitor_already_active, the MONITOR is refused.
    };

    /// The command in flight.
    enum class EAsked : std::uint8_t
    {
        Nothing,
        Start,
        Stop,
        Refused, ///< None; the last one was a MONITOR that was refused.
    };

    const ClientSessionOptions& _options;
    std::optional<MonitorRequest> _wanted;
    std::uint64_t _wantedNumber = 0; ///< Of the last Set call.
    bool _bDue = false;              ///< What is wanted was not sent yet.
    EAsked _asked = EAsked::Nothing;
    std::uint64_t _sentNumber = 0;                         ///< Of the last MONITOR sent.
    std::string _sentURL;                                  ///< Likewise.
    std::chrono::milliseconds _sentPeriod{MINIMUM_PERIOD}; ///< Likewise.
    EStream _stream = EStream::Nothing;
    std::uint64_t _startedNumber = 0; ///< Of the last MONITOR that the server accepted.

    StreamMeter _meter; ///< Of the MONITOR that the server streams: a replacement counts from its acknowledgement.
    Core::SteadyTime _lastDataAt;
    bool _bStale = false;
    LazyTimer _ageTimer;
    std::optional<ClientData> _latest;

public:
    /// The options must outlive it.
    explicit ClientMonitor(const ClientSessionOptions& options);

    void Set(std::optional<MonitorRequest> monitorOrNull);

    /// The connection was lost or closed: the MONITOR is due again in the next session.
    void OnDisconnected();

    /// The command to send next, which is then in flight; nullopt if none is due.
    [[nodiscard]] std::optional<OpenStreamRequest> BeginNextOrNull();

    /// The server accepted the MONITOR in flight, or the one that was refused: the refusal was of a streamed CONTROL.
    void OnStarted(Core::Now now, ClientActions& out);

    /// The server refused the MONITOR in flight.
    void OnRefused(ErrorLine error, ClientActions& out);

    /// The STOP monitor in flight was answered: nothing is streamed.
    void OnStopped(ClientActions& out);

    /// A sample arrived. Returns the number of periods that were skipped before it.
    std::uint64_t OnSample(DataLine line, Core::Now now, ClientActions& out);

    /// The DataAge timer fired. False: the data is overdue for lostAfter.
    [[nodiscard]] bool TryAwaitData(Core::Now now, ClientActions& out);

    [[nodiscard]] bool IsWanted() const noexcept;
    /// Whether a MONITOR or a STOP monitor is in flight.
    [[nodiscard]] bool IsInFlight() const noexcept;
    [[nodiscard]] bool IsStarting() const noexcept;
    /// Whether no command was sent after a MONITOR that was refused.
    [[nodiscard]] bool IsRefused() const noexcept;
    [[nodiscard]] bool IsStopping() const noexcept;
    [[nodiscard]] const ClientData* GetLatestOrNull() const noexcept;
    [[nodiscard]] StreamQuality GetQuality() const;

private:
    /// Whether the server streams nothing, as far as known.
    [[nodiscard]] bool IsSilent() const noexcept;
    /// Whether the server streams the MONITOR of the last Set call.
    [[nodiscard]] bool IsCurrent() const noexcept;
    [[nodiscard]] std::chrono::milliseconds GetDataLimit() const noexcept;
    void ArmAgeTimer(ClientActions& out);
    void FinishAsked(ClientActions& out);
};

} // namespace ACS::OpenStream
