// Lesson 3: both ends of MCS-ACS in one process, without a socket, a thread or a clock.
//
// The sessions are pure: events and the time go in, actions come out. The code that carries out the actions decides what the
// network is; here it is two vectors, and the time is a variable. So a lost Ack and the five seconds after it cost
// nothing. AcsClient and McsServer (lesson 4) carry out the same actions over a WebSocket.

#include "ExampleRandom.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/protocol/AcsSession.hpp>
#include <acs/protocol/McsSession.hpp>

#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>
#include <variant>

using namespace ACS; // NOLINT(google-build-using-namespace): an example reads better without the prefix

namespace
{

/// The two sessions and what lies between them.
class Line
{
    static constexpr Protocol::ConnectionID CONNECTION = 1;

    ExampleRandom _random;
    Core::Now _now;
    Protocol::AcsSession _acs;
    Protocol::McsSession _mcs;
    Protocol::SessionActions _fromACS;
    Protocol::SessionActions _fromMCS;
    std::map<Protocol::ESessionTimer, Core::SteadyTime> _acsTimers; ///< When each is due.

public:
    bool bNextAckLost = false; ///< The line eats the next text from the MCS.
    bool bRegistered = false;
    bool bAcked = false;

    explicit Line(const Protocol::SessionOptions& options)
        : _acs(options, _random),
          _mcs({}, _random)
    {
        _acs.Start(_now, _fromACS);
    }

    /// Carries out what both sides want until neither wants anything. Actions never run inside the call that made them.
    void Settle()
    {
        while (!_fromACS.empty() || !_fromMCS.empty())
        {
            for (const Protocol::SessionAction& action : std::exchange(_fromACS, {}))
            {
                ExecuteForACS(action);
            }
            for (const Protocol::SessionAction& action : std::exchange(_fromMCS, {}))
            {
                ExecuteForMCS(action);
            }
        }
    }

    /// The id and the time of a report are the caller's, and the same on every attempt: so a repetition shows as one.
    [[nodiscard]] bool TryReport(const Protocol::PlanReport& report)
    {
        _acs.ReplayDone(_now, _fromACS); // Nothing is left over from an earlier connection.
        return _acs.TrySendDurable({"report-1", {_now.wall, {}}, report}, _now, _fromACS);
    }

    /// Time jumps to the deadline of the Ack.
    void WaitForAck()
    {
        _now.steady = _acsTimers[Protocol::ESessionTimer::Ack];
        Print("ACS", "no Ack, again");
        _acs.OnTimer(Protocol::ESessionTimer::Ack, _now, _fromACS);
    }

private:
    void Print(std::string_view who, std::string_view what) const
    {
        const auto time = std::chrono::duration_cast<std::chrono::milliseconds>(_now.steady.time_since_epoch());
        fmt::print("[{:>4} ms] {}: {}\n", time.count(), who, what);
    }

    void ExecuteForACS(const Protocol::SessionAction& action)
    {
        std::visit(
            Core::Overloaded{
                [this](const Protocol::Connect&) {
                    _mcs.OnConnected(CONNECTION, _now, _fromMCS);
                    _acs.OnConnected(_now, _fromACS);
                },
                [this](const Protocol::SendText& send) {
                    Print("ACS", send.text);
                    _mcs.OnText(CONNECTION, send.text, _now, _fromMCS);
                },
                [this](const Protocol::Close& close) { _acs.OnClosed(close.reason, _now, _fromACS); },
                [this](const Protocol::StartTimer& start) { _acsTimers[start.timer] = _now.steady + start.delay; },
                [this](const Protocol::CancelTimer& cancel) { _acsTimers.erase(cancel.timer); },
                [this](const Protocol::Deliver& deliver) {
                    bRegistered = bRegistered || std::holds_alternative<Protocol::Registered>(deliver.event);
                    bAcked = bAcked || std::holds_alternative<Protocol::Acked>(deliver.event);
                }},
            action);
    }

    /// The MCS of this lesson only acknowledges, and for that it needs no timers.
    void ExecuteForMCS(const Protocol::SessionAction& action)
    {
        const auto* sendOrNull = std::get_if<Protocol::SendText>(&action);
        if (sendOrNull == nullptr)
        {
            return;
        }
        const bool bLost = std::exchange(bNextAckLost, false);
        Print(bLost ? "lost" : "MCS", sendOrNull->text);
        if (!bLost)
        {
            _acs.OnText(sendOrNull->text, _now, _fromACS);
        }
    }
};

} // namespace

int main() // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    Protocol::SessionOptions options;
    options.positionInterval = {}; // No positions: they would fill the output five times a second.
    Line line(options);
    line.Settle();

    line.bNextAckLost = true;
    if (!line.bRegistered || !line.TryReport({"PLAN-1", Protocol::EPlanStatus::InProgress, ""}))
    {
        return 1;
    }
    line.Settle();
    line.WaitForAck();
    line.Settle();
    fmt::print("report-1 is {}acknowledged\n", line.bAcked ? "" : "not ");
    return line.bAcked ? 0 : 1;
}
