#pragma once

#include "ManualClock.hpp"
#include "SeededRandom.hpp"
#include <acs/openstream/ClientSession.hpp>

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Testing
{

inline constexpr std::string_view HANDSHAKE_ACK = "{\"type\":\"handshake_ack\",\"ok\":true,\"version\":\"1.0.0\"}\n";
inline constexpr std::string_view MONITOR_ACK = "{\"type\":\"monitor_ack\"}\n";
inline constexpr std::string_view CONTROL_REFUSAL = "{\"type\":\"control_err\",\"status\":403}\n";
inline constexpr std::string_view REQUEST_REFUSAL = "{\"error\":\"url_too_long\",\"message\":\"m\"}\n";

/// A OpenStream::ClientSession in virtual time. A send leaves at once unless bSocketTakes is false.
class ClientFixture
{
public:
    ManualClock clock;
    SeededRandom random;
    OpenStream::ClientSession session;
    std::vector<std::string> lines;
    std::vector<OpenStream::ClientEvent> events;
    int connects = 0;
    int closes = 0;
    bool bSocketTakes = true;
    OpenStream::ClientActions actions;

private:
    std::array<std::optional<Core::SteadyTime>, OpenStream::CLIENT_TIMER_COUNT> _deadlines;

public:
    explicit ClientFixture(const OpenStream::ClientSessionOptions& options = {})
        : session(options, random)
    {
    }

    [[nodiscard]] Core::Now GetNow() const
    {
        return clock.GetNow();
    }

    void Execute()
    {
        std::size_t index = 0;
        while (index < actions.size()) // grows underway
        {
            const OpenStream::ClientAction action = actions[index];
            std::visit([this](const auto& content) { Do(content); }, action);
            ++index;
        }
        actions.clear();
    }

    void Receive(std::string_view bytes)
    {
        session.OnBytes(bytes, GetNow(), actions);
        Execute();
    }

    /// Completes a send of a socket that is blocked.
    void CompleteSend()
    {
        session.OnSendCompleted(GetNow(), actions);
        Execute();
    }

    void Start()
    {
        session.Start(GetNow(), actions);
        Execute();
    }

    void ConnectAndShake()
    {
        session.OnConnected(GetNow(), actions);
        Execute();
        Receive(HANDSHAKE_ACK);
    }

    void SetMonitor(std::chrono::milliseconds period)
    {
        session.SetMonitor(OpenStream::MonitorRequest{"/project/rgen", period, {}, {}}, GetNow(), actions);
        Execute();
    }

    std::uint64_t Control(
        const std::string& url,
        OpenStream::EControlTracking tracking = OpenStream::EControlTracking::Tracked)
    {
        const std::uint64_t token = session.SendControl(
            OpenStream::ControlRequest{OpenStream::EApiMethod::Post, url, {}, {}},
            tracking,
            GetNow(),
            actions);
        Execute();
        return token;
    }

    std::uint64_t Call(OpenStream::ControlCall call)
    {
        const std::uint64_t token = session.SendControlCall(std::move(call), GetNow(), actions);
        Execute();
        return token;
    }

    void StopControl()
    {
        session.StopControl(GetNow(), actions);
        Execute();
    }

    void StopMonitor()
    {
        session.SetMonitor(std::nullopt, GetNow(), actions);
        Execute();
    }

    void Pass(std::chrono::milliseconds span)
    {
        for (std::chrono::milliseconds passed{0}; passed < span; ++passed)
        {
            clock.Advance(std::chrono::milliseconds(1));
            for (std::size_t index = 0; index < _deadlines.size(); ++index)
            {
                if (_deadlines.at(index).has_value() && *_deadlines.at(index) <= GetNow().steady)
                {
                    _deadlines.at(index).reset();
                    session.OnTimer(static_cast<OpenStream::EClientTimer>(index), GetNow(), actions);
                    Execute();
                }
            }
        }
    }

    template <typename TEvent>
    [[nodiscard]] std::vector<TEvent> Take()
    {
        std::vector<TEvent> taken;
        for (const OpenStream::ClientEvent& event : events)
        {
            if (const auto* match = std::get_if<TEvent>(&event))
            {
                taken.push_back(*match);
            }
        }
        std::erase_if(events, [](const OpenStream::ClientEvent& event) {
            return std::holds_alternative<TEvent>(event);
        });
        return taken;
    }

    [[nodiscard]] std::size_t CountLines(std::string_view part) const
    {
        std::size_t count = 0;
        for (const std::string& line : lines)
        {
            count += line.find(part) == std::string::npos ? 0U : 1U;
        }
        return count;
    }

private:
    void Do(const OpenStream::ClientEvent& event)
    {
        events.push_back(event);
    }

    void Do(const OpenStream::ClientConnect& /*action*/)
    {
        ++connects;
    }

    void Do(const OpenStream::ClientSend& action)
    {
        std::string_view rest = action.text;
        while (!rest.empty())
        {
            const std::size_t end = rest.find('\n');
            lines.emplace_back(rest.substr(0, end));
            rest.remove_prefix(end + 1);
        }
        if (bSocketTakes)
        {
            session.OnSendCompleted(clock.GetNow(), actions);
        }
    }

    void Do(const OpenStream::ClientClose& /*action*/)
    {
        ++closes;
    }

    void Do(const OpenStream::ClientStartTimer& action)
    {
        _deadlines.at(static_cast<std::size_t>(action.timer)) = action.deadline;
    }

    void Do(const OpenStream::ClientCancelTimer& action)
    {
        _deadlines.at(static_cast<std::size_t>(action.timer)).reset();
    }
};

inline void MakeReady(ClientFixture& client)
{
    client.Start();
    client.ConnectAndShake();
    client.lines.clear();
    client.events.clear();
}

inline std::string MakeData(int ts)
{
    return R"({"type":"data","ts":)" + std::to_string(ts) + R"(,"svc_dur_ms":0.1,"result":{"a":1}})" + "\n";
}

} // namespace ACS::Testing
