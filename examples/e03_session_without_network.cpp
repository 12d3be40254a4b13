// Lesson 3: both ends of MCS-ACS in one process, without a socket, a thread or a clock.
//
// The sessions are pure: events and the time go in, actions come out. Whoever carries out the actions decides what the
// network is; here it is two vectors, and the time is a variable. So a lost Ack and the five seconds after it cost
// nothing, and every run is the same. AcsClient and McsServer (lesson 4) carry out the same actions over a WebSocket.

#include <acs/core/Overloaded.hpp>
#include <acs/protocol/AcsSession.hpp>
#include <acs/protocol/McsSession.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <variant>

using namespace ACS; // NOLINT(google-build-using-namespace): an example reads better without the prefix

namespace
{

/// Always the same ids: a lesson wants to be repeatable. A program takes a real random source.
class CountingRandom final : public Core::IRandom
{
    std::uint64_t _last = 0;

public:
    [[nodiscard]] std::uint64_t GetNext() override
    {
        return ++_last;
    }
};

/// The two sessions and what lies between them.
class Line
{
    static constexpr Protocol::ConnectionID CONNECTION = 1;

    CountingRandom _random;
    Core::Now _now;
    Protocol::AcsSession _acs;
    Protocol::McsSession _mcs;
    Protocol::SessionActions _fromAcs;
    Protocol::SessionActions _fromMcs;
    std::map<Protocol::ESessionTimer, Core::SteadyTime> _acsTimers;

public:
    bool bNextAckLost = false; ///< The line eats the next text from the MCS.
    bool bFinished = false;    ///< The report was acknowledged.

    explicit Line(const Protocol::SessionOptions& options)
        : _acs(options, _random),
          _mcs({}, _random)
    {
    }

    void Start()
    {
        _acs.Start(_now, _fromAcs);
        Settle();
    }

    [[nodiscard]] bool TryReport(const std::string& planID)
    {
        // The id and the time are the caller's, and the same on every attempt: that makes a repetition recognisable.
        const Protocol::AcsRequest request{
            "report-1",
            {_now.wall, {}},
            Protocol::PlanReport{planID, Protocol::EPlanStatus::InProgress, ""}};
        const bool bTaken = _acs.TrySendDurable(request, _now, _fromAcs);
        Settle();
        return bTaken;
    }

    /// Time jumps to the next timer. False: there is none.
    [[nodiscard]] bool TryAdvance()
    {
        const auto next =
            std::min_element(_acsTimers.begin(), _acsTimers.end(), [](const auto& left, const auto& right) {
                return left.second < right.second;
            });
        if (next == _acsTimers.end())
        {
            return false;
        }
        const Protocol::ESessionTimer timer = next->first;
        _now.steady = next->second;
        _acsTimers.erase(next);
        fmt::print("[{:>5} ms] a timer of the ACS is due\n", GetMilliseconds());
        _acs.OnTimer(timer, _now, _fromAcs);
        Settle();
        return true;
    }

private:
    [[nodiscard]] long long GetMilliseconds() const
    {
        return std::chrono::duration_cast<std::chrono::milliseconds>(_now.steady.time_since_epoch()).count();
    }

    /// Carries out what both sides want until neither wants anything. Actions never run inside the call that made them.
    void Settle()
    {
        while (!_fromAcs.empty() || !_fromMcs.empty())
        {
            for (const Protocol::SessionAction& action : std::exchange(_fromAcs, {}))
            {
                ExecuteForAcs(action);
            }
            for (const Protocol::SessionAction& action : std::exchange(_fromMcs, {}))
            {
                ExecuteForMcs(action);
            }
        }
    }

    void ExecuteForAcs(const Protocol::SessionAction& action)
    {
        std::visit(
            Core::Overloaded{
                [this](const Protocol::Connect&) {
                    _mcs.OnConnected(CONNECTION, _now, _fromMcs);
                    _acs.OnConnected(_now, _fromAcs);
                },
                [this](const Protocol::SendText& send) {
                    fmt::print("[{:>5} ms] ACS: {}\n", GetMilliseconds(), send.text);
                    _mcs.OnText(CONNECTION, send.text, _now, _fromMcs);
                },
                [this](const Protocol::Close& close) { _acs.OnClosed(close.reason, _now, _fromAcs); },
                [this](const Protocol::StartTimer& start) { _acsTimers[start.timer] = _now.steady + start.delay; },
                [this](const Protocol::CancelTimer& cancel) { _acsTimers.erase(cancel.timer); },
                [this](const Protocol::Deliver& deliver) {
                    OnAcsEvent(deliver.event);
                }},
            action);
    }

    void OnAcsEvent(const Protocol::SessionEvent& event)
    {
        if (std::holds_alternative<Protocol::Registered>(event))
        {
            _acs.ReplayDone(_now, _fromAcs); // Nothing is left over from an earlier connection.
        }
        else if (const auto* ackedOrNull = std::get_if<Protocol::Acked>(&event))
        {
            fmt::print("[{:>5} ms] {} is acknowledged\n", GetMilliseconds(), ackedOrNull->transactionID);
            bFinished = true;
        }
    }

    /// The MCS of this lesson only acknowledges, and for that it needs no timers.
    void ExecuteForMcs(const Protocol::SessionAction& action)
    {
        const auto* sendOrNull = std::get_if<Protocol::SendText>(&action);
        if (sendOrNull == nullptr)
        {
            return;
        }
        const bool bLost = std::exchange(bNextAckLost, false);
        fmt::print("[{:>5} ms] MCS: {}{}\n", GetMilliseconds(), sendOrNull->text, bLost ? " (lost)" : "");
        if (!bLost)
        {
            _acs.OnText(sendOrNull->text, _now, _fromAcs);
        }
    }
};

} // namespace

int main()
{
    Protocol::SessionOptions options;
    options.positionInterval = {}; // No positions: they would fill the output five times a second.
    Line line(options);
    line.Start();

    line.bNextAckLost = true;
    if (!line.TryReport("PLAN-1"))
    {
        return 1;
    }
    while (!line.bFinished && line.TryAdvance())
    {
    }
    return line.bFinished ? 0 : 1;
}
