#pragma once

#include "ManualClock.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/openstream/ServerSession.hpp>

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Testing
{

/// A ServerSession in virtual time: fires its timers, records what it sends, answers for the service.
class ServerFixture
{
public:
    ManualClock clock;
    OpenStream::ServerSession session;
    std::vector<std::string> lines; ///< What left, cut at the line ends.
    std::vector<OpenStream::ApiRequest> calls;
    std::vector<std::uint64_t> unanswered; ///< Tokens, where bServiceAnswers is false.
    OpenStream::ApiResponse answer{200, Core::JsonText::FromTrusted("{}")};
    std::optional<OpenStream::EServerCloseReason> closed;
    bool bServiceAnswers = true;
    bool bSocketTakes = true; ///< Whether what is sent leaves at once.
    bool bReadingPaused = false;
    bool bSendShutDown = false;
    bool bContinueWanted = false;
    int stopControls = 0;

private:
    std::array<std::optional<Core::SteadyTime>, OpenStream::SERVER_TIMER_COUNT> _deadlines;
    OpenStream::ServerActions _actions;
    bool _bSendPending = false;

public:
    explicit ServerFixture(const OpenStream::ServerSessionOptions& options = {})
        : session(options)
    {
        session.Start(clock.GetNow(), _actions);
        Execute();
    }

    void Receive(std::string_view bytes)
    {
        session.OnBytes(bytes, clock.GetNow(), _actions);
        Execute();
    }

    void Continue()
    {
        bContinueWanted = false;
        session.OnContinue(clock.GetNow(), _actions);
        Execute();
    }

    void Answer(std::uint64_t token)
    {
        session.OnServiceAnswer(token, answer, clock.GetNow(), _actions);
        Execute();
    }

    void ClosePeer()
    {
        session.OnPeerClosed(clock.GetNow(), _actions);
        Execute();
    }

    void Reject()
    {
        session.Reject("no room", clock.GetNow(), _actions);
        Execute();
    }

    /// Completes the pending sends of the socket.
    void Drain()
    {
        bSocketTakes = true;
        if (_bSendPending)
        {
            CompleteSend();
            Execute();
        }
    }

    /// Time passes, a millisecond at a time.
    void Pass(std::chrono::milliseconds span)
    {
        for (std::chrono::milliseconds passed{0}; passed < span; ++passed)
        {
            clock.Advance(std::chrono::milliseconds(1));
            FireDueTimers();
        }
    }

    /// Time passes without a timer being fired before its end: a stall of the machine.
    void Stall(std::chrono::milliseconds span)
    {
        clock.Advance(span);
        FireDueTimers();
    }

    /// The lines since the last call.
    [[nodiscard]] std::vector<std::string> TakeLines()
    {
        return std::exchange(lines, {});
    }

    [[nodiscard]] std::size_t Count(std::string_view part) const
    {
        std::size_t count = 0;
        for (const std::string& line : lines)
        {
            count += line.find(part) == std::string::npos ? 0U : 1U;
        }
        return count;
    }

private:
    void Execute()
    {
        std::size_t index = 0;
        while (index < _actions.size()) // grows underway
        {
            const OpenStream::ServerAction action = _actions[index];
            std::visit([this](const auto& content) { Do(content); }, action);
            ++index;
        }
        _actions.clear();
    }

    void Do(const OpenStream::ServerSend& action)
    {
        std::string_view rest = action.text;
        while (!rest.empty())
        {
            const std::size_t end = rest.find('\n');
            lines.emplace_back(rest.substr(0, end));
            rest.remove_prefix(end + 1);
        }
        _bSendPending = true;
        if (bSocketTakes)
        {
            CompleteSend();
        }
    }

    void CompleteSend()
    {
        _bSendPending = false;
        session.OnSendCompleted(clock.GetNow(), _actions);
    }

    void Do(const OpenStream::ServerCall& action)
    {
        calls.push_back(*action.request);
        if (bServiceAnswers)
        {
            session.OnServiceAnswer(action.token, answer, clock.GetNow(), _actions);
        }
        else
        {
            unanswered.push_back(action.token);
        }
    }

    void Do(const OpenStream::ServerStopControl& /*action*/)
    {
        ++stopControls;
    }

    void Do(const OpenStream::ServerStartTimer& action)
    {
        _deadlines.at(static_cast<std::size_t>(action.timer)) = action.deadline;
    }

    void Do(const OpenStream::ServerCancelTimer& action)
    {
        _deadlines.at(static_cast<std::size_t>(action.timer)).reset();
    }

    void Do(const OpenStream::ServerPauseReading& /*action*/)
    {
        bReadingPaused = true;
    }

    void Do(const OpenStream::ServerResumeReading& /*action*/)
    {
        bReadingPaused = false;
    }

    void Do(const OpenStream::ServerContinue& /*action*/)
    {
        bContinueWanted = true;
    }

    void Do(const OpenStream::ServerShutdownSend& /*action*/)
    {
        bSendShutDown = true;
    }

    void Do(const OpenStream::ServerClose& action)
    {
        closed = action.reason;
    }

    void FireDueTimers()
    {
        for (std::size_t index = 0; index < _deadlines.size(); ++index)
        {
            if (_deadlines.at(index).has_value() && *_deadlines.at(index) <= clock.GetNow().steady)
            {
                _deadlines.at(index).reset();
                session.OnTimer(static_cast<OpenStream::EServerTimer>(index), clock.GetNow(), _actions);
                Execute();
            }
        }
    }
};

inline constexpr std::string_view HANDSHAKE = "{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":1}}\n";
inline constexpr std::string_view CONTROL =
    "{\"cmd\":\"CONTROL\",\"payload\":{\"method\":\"POST\",\"url\":\"/project/robot/start\"}}\n";

inline std::string MakeMonitorLine(int periodMs, const std::string& url = "/project/robot/joints/joint_states")
{
    return R"({"cmd":"MONITOR","payload":{"method":"GET","url":")" + url + R"(","period_ms":)"
        + std::to_string(periodMs) + "}}\n";
}

inline std::string MakeStopLine(const std::string& target)
{
    return R"({"cmd":"STOP","payload":{"target":")" + target + "\"}}\n";
}

} // namespace ACS::Testing
