#include "PlanSender.hpp"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>
#include <utility>
#include <variant>

namespace ACS::Load
{

namespace
{

constexpr std::chrono::seconds TIME_LIMIT{60};

} // namespace

Protocol::ExecutionPlan MakePlan(std::size_t number)
{
    Protocol::ExecutionPlan plan;
    plan.planID = fmt::format("PLAN-{:06}", number);
    plan.lotID = "LOT-1";
    plan.priority = 1;
    plan.steps = {
        {1,
         "CassetteLoad",
         "A01.CP01",
         {"CASSETTE-1"},
         {{fmt::format("c0a80101-0000-4000-8000-{:012}", 2 * number), "A01.CP01", "AMR.CP01"}}},
        {2,
         "CassetteUnload",
         "A01.CP02",
         {"CASSETTE-1"},
         {{fmt::format("c0a80101-0000-4000-8000-{:012}", 2 * number + 1), "AMR.CP01", "A01.CP02"}}}};
    return plan;
}

PlanSender::PlanSender(boost::asio::io_context& context)
    : _context(context)
{
    ProtocolBeast::ServerOptions options;
    options.session.ackTimeout = TIME_LIMIT;
    auto server =
        ProtocolBeast::McsServer::Create(context.get_executor(), _clock, _random, Core::Logger(), options, *this);
    if (!server)
    {
        throw std::runtime_error(Core::Describe(server.error()));
    }
    _server = std::move(*server);
}

std::uint16_t PlanSender::GetPort() const
{
    return _server->GetPort();
}

void PlanSender::WaitForACS()
{
    RunUntil([this]() { return _server->IsRegistered(); }, "acsd did not register");
}

Core::Duration PlanSender::Send(std::size_t plans)
{
    const Core::SteadyTime begin = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < plans; ++i)
    {
        ++_sent;
        if (!_server->TrySend(_server->MakeRequest(MakePlan(_sent))))
        {
            throw std::runtime_error("cannot send a plan");
        }
    }
    RunUntil([this]() { return _accepted + _refused == _sent; }, "not every plan was acknowledged");
    return std::chrono::steady_clock::now() - begin;
}

std::size_t PlanSender::GetAccepted() const noexcept
{
    return _accepted;
}

const std::string& PlanSender::GetFirstRefusal() const noexcept
{
    return _firstRefusal;
}

void PlanSender::OnSessionEvent(const Protocol::SessionEvent& event)
{
    const auto* const receivedOrNull = std::get_if<Protocol::AckReceived>(&event);
    if (receivedOrNull == nullptr)
    {
        return;
    }
    if (receivedOrNull->ack.result == Protocol::EAckResult::Success)
    {
        ++_accepted;
    }
    else if (_refused++ == 0)
    {
        _firstRefusal = receivedOrNull->ack.message;
    }
}

void PlanSender::RunUntil(const std::function<bool()>& isTrue, std::string_view what)
{
    const Core::SteadyTime end = std::chrono::steady_clock::now() + TIME_LIMIT;
    while (!isTrue())
    {
        if (_context.run_one_until(end) == 0)
        {
            throw std::runtime_error(fmt::format("{} after {} s", what, TIME_LIMIT.count()));
        }
    }
}

} // namespace ACS::Load
