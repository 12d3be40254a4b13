#pragma once

#include "Choices.hpp"
#include "FuzzCheck.hpp"
#include "SeededRandom.hpp"
#include <acs/protocol/AcsCodec.hpp>
#include <acs/protocol/AcsSession.hpp>

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace ACS::Fuzz
{

/// The connection, the clock and the user of an AcsSession. Checks: one connection at a time and texts on an open one only;
/// Registration first; events of a registered session between Registered and the end of the connection only; no more requests
/// without an Ack than the window; an Acked for each accepted request at most once; nothing after Stopped.
class AcsPeer
{
    enum class EConnection : std::uint8_t
    {
        None,
        Opening,
        Open,
        Closing, ///< The session has asked for it.
    };

    Core::Now _now{Core::SteadyTime{}, {}};
    Testing::SeededRandom _random;
    Protocol::SessionOptions _options;
    Protocol::AcsSession _session;
    Protocol::AcsCodec _codec;
    Protocol::SessionActions _actions;
    std::array<std::optional<Core::SteadyTime>, Protocol::TIMER_COUNT> _deadlines;
    EConnection _connection = EConnection::None;
    std::deque<Protocol::AcsRequest> _sent; ///< On this connection, without an Ack.
    std::set<std::string> _accepted;        ///< Requests that wait for an Ack on this connection.
    std::set<std::string> _late;            ///< Requests whose Ack did not come in time.
    std::uint64_t _requests = 0;
    bool _bRegistrationSent = false; ///< On this connection.
    bool _bRegistered = false;
    bool _bStarted = false;

public:
    explicit AcsPeer(const Protocol::SessionOptions& options);

    void Start();
    void Stop();
    void Connect();
    void CloseConnection();
    void PassTime(std::chrono::milliseconds span);
    void Receive(std::string_view text);
    /// Acknowledges one of the requests that wait for it.
    void Acknowledge(std::uint32_t choice, Protocol::EAckResult result);
    void SendReport();
    void SendStatus(std::uint32_t robot, std::uint32_t status);
    void SendPosition();
    void FinishReplay();

private:
    void Execute();
    void Carry(const Protocol::SessionAction& action);
    void Send(const Protocol::SendText& action);
    void Deliver(const Protocol::SessionEvent& event);
};

} // namespace ACS::Fuzz
