#pragma once

#include "common/process/SystemClock.hpp"
#include "common/process/SystemRandom.hpp"
#include <acs/core/Now.hpp>
#include <acs/protocol_beast/ISessionHandler.hpp>
#include <acs/protocol_beast/McsServer.hpp>

#include <boost/asio/io_context.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace ACS::Load
{

/// The example site's transport of a cassette.
[[nodiscard]] Protocol::ExecutionPlan MakePlan(std::size_t number);

/// An MCS that sends plans and counts their Acks. Throws std::runtime_error when a time limit is over.
class PlanSender final : private ProtocolBeast::ISessionHandler
{
    boost::asio::io_context& _context;
    Apps::SystemClock _clock;
    Apps::SystemRandom _random;
    std::unique_ptr<ProtocolBeast::McsServer> _server;
    std::size_t _sent = 0;
    std::size_t _accepted = 0;
    std::size_t _refused = 0;
    std::string _firstRefusal;

public:
    explicit PlanSender(boost::asio::io_context& context);

    [[nodiscard]] std::uint16_t GetPort() const;
    void WaitForACS();

    /// Sends this number of plans at once; returns when each is acknowledged.
    [[nodiscard]] Core::Duration Send(std::size_t plans);

    [[nodiscard]] std::size_t GetAccepted() const noexcept;
    /// Empty if none was refused.
    [[nodiscard]] const std::string& GetFirstRefusal() const noexcept;

private:
    void OnSessionEvent(const Protocol::SessionEvent& event) override;
    void RunUntil(const std::function<bool()>& isTrue, std::string_view what);
};

} // namespace ACS::Load
