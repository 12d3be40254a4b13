#pragma once

#include "Choices.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/openstream/ClientSession.hpp>
#include <acs/openstream/OpenStreamCodec.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Fuzz
{

/// The connection, the controller, the caller and the clock of a ClientSession. Checks: one send in flight, complete and valid
/// lines, HANDSHAKE first, one command in flight, one outcome per CONTROL that is true, the MONITOR that was set last, timers
/// in the future, bounded output, nothing after the close.
class ClientPeer final : private Core::IRandom
{
public:
    /// How the controller answers a command.
    enum class EAnswer : std::uint8_t
    {
        Accepted,
        Refused,
        RefusedAsActive, ///< A MONITOR because of the one that runs.
    };

private:
    enum class EConnection : std::uint8_t
    {
        Closed,
        Connecting,
        Open,
    };

    /// A CONTROL of the caller. Its url is its number.
    struct Control
    {
        std::uint64_t token = 0;
        std::uint64_t session = 0; ///< In which it was passed to the session.
        bool bTracked = true;
        bool bSent = false;      ///< Its line was given to the socket.
        bool bConfirmed = false; ///< A sample satisfied its predicate.
        std::optional<Core::SteadyTime> writtenAt;
        std::optional<std::chrono::milliseconds> confirmWithin; ///< Absent: no confirmation.
        std::optional<OpenStream::EControlOutcome> outcome;
    };

    /// A command whose answer the session waits for.
    struct Awaited
    {
        OpenStream::EOpenStreamCommand command = OpenStream::EOpenStreamCommand::Handshake;
        std::size_t control = 0; ///< Index of a CONTROL.
    };

    OpenStream::ClientSessionOptions _options;
    Core::Now _now{Core::SteadyTime{}, {}};
    OpenStream::ClientSession _session;
    OpenStream::ClientActions _actions;
    OpenStream::OpenStreamCodec _codec;
    std::array<std::optional<Core::SteadyTime>, OpenStream::CLIENT_TIMER_COUNT> _deadlines;
    EConnection _connection = EConnection::Closed;
    bool _bEnded = true;                                 ///< Stopped, or not started yet.
    std::uint64_t _sessions = 0;                         ///< Number of connection attempts.
    std::optional<std::string_view> _sending;            ///< In the memory of the session.
    std::string _sendingCopy;                            ///< What it was when it was given.
    std::deque<OpenStream::OpenStreamRequest> _received; ///< Not answered yet.
    std::string _unread;                                 ///< Bytes to the session that are no whole line yet.
    std::vector<OpenStream::OpenStreamLine> _answers;    ///< Lines that the session may have used as answers.
    std::optional<Awaited> _awaited;
    bool _bReady = false; ///< ClientReady was reported in this connection.
    bool _bHandshakeSent = false;
    bool _bAcked = false;   ///< The controller sent a handshake_ack.
    bool _bHostile = false; ///< The controller sent what does not answer a command.
    std::vector<Control> _controls;
    std::uint64_t _monitorCalls = 0;
    std::optional<OpenStream::MonitorRequest> _monitor; ///< Set last.
    std::uint64_t _sentMonitor = 0;    ///< Number of the SetMonitor call of the last MONITOR line; 0: none.
    std::uint64_t _startedMonitor = 0; ///< Of the last ClientMonitorStarted in this connection.
    std::uint64_t _servedMonitor = 0;  ///< What the controller streams; 0: nothing.
    bool _bRefused = false;            ///< The MONITOR that was set last was refused.
    double _ts = 0.0;
    Core::SteadyTime _lastSampleAt;
    bool _bStale = false;
    std::uint64_t _linesAtStale = 0; ///< Number of data lines when stale data was reported last.
    std::uint64_t _samples = 0;
    std::uint64_t _connects = 0;

public:
    explicit ClientPeer(const OpenStream::ClientSessionOptions& options);

    void Start();
    void Stop();
    void SetMonitor(std::optional<std::chrono::milliseconds> periodOrNull);
    void SendControl(Choices& choices);
    void StopControl();
    /// The connection attempt succeeds or fails.
    void EndConnecting(bool bConnected);
    void CompleteSend();
    /// The controller answers its oldest command.
    void AnswerNext(EAnswer answer);
    void SendSample();
    /// Sends bytes that no command asked for.
    void SendHostile(std::string_view bytes);
    void ClosePeer();
    void BreakSocket();
    void PassTime(std::chrono::milliseconds span);

    /// A controller that works brings the session to what its caller has set; then the session ends.
    void End();

private:
    [[nodiscard]] std::uint64_t GetNext() override;
    void Deliver(std::string_view bytes);
    void Deliver(const OpenStream::OpenStreamLine& line);
    void Execute();
    void Do(const OpenStream::ClientConnect& action);
    void Do(const OpenStream::ClientSend& action);
    void Do(const OpenStream::ClientClose& action);
    void Do(const OpenStream::ClientStartTimer& action);
    void Do(const OpenStream::ClientCancelTimer& action);
    void Do(const OpenStream::ClientEvent& event);
    void On(const OpenStream::ClientReady& event);
    void On(const OpenStream::ClientMonitorStarted& event);
    void On(const OpenStream::ClientMonitorRefused& event);
    void On(const OpenStream::ClientData& event);
    void On(const OpenStream::ClientMonitorStale& event);
    void On(const OpenStream::ClientControlSettled& event);
    void On(const OpenStream::ClientControlFault& event);
    void On(const OpenStream::ClientStopped& event) const;
    void On(const OpenStream::ClientErrorReported& event) const;
    void On(const OpenStream::ClientBadLine& event) const;
    void On(const OpenStream::ClientLost& event);
    void On(const OpenStream::ClientEnded& event);
    void CheckSentLine(const OpenStream::OpenStreamRequest& request);
    void CheckSentControl(const OpenStream::ControlRequest& request);
    void Await(Awaited awaited);
    [[nodiscard]] bool IsAnswered(const Awaited& awaited);
    void Forget();
    void CheckState() const;
    void CheckTimers() const;
    void CheckDataAge() const;
    void FireTimers();
    [[nodiscard]] bool IsConfirmed(std::size_t index, const OpenStream::DataLine& sample);
    void Work(std::chrono::milliseconds span);
    void CheckWorks();
};

} // namespace ACS::Fuzz
