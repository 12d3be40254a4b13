#pragma once

#include <acs/protocol/SessionAction.hpp>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace ACS::ProtocolBeast
{

/// The timers that a session asks for.
class SessionTimers : public std::enable_shared_from_this<SessionTimers>
{
    std::vector<boost::asio::steady_timer> _timers;
    std::array<std::uint64_t, Protocol::TIMER_COUNT> _rounds{};
    std::function<void(Protocol::ESessionTimer)> _onTimer;

public:
    SessionTimers(const boost::asio::any_io_executor& executor, std::function<void(Protocol::ESessionTimer)> onTimer);

    void Start(const Protocol::StartTimer& action);
    void Cancel(Protocol::ESessionTimer timer);

    /// Nothing fires any more.
    void Detach();
};

} // namespace ACS::ProtocolBeast
