#include "PlanKeeper.hpp"

#include "CellSite.hpp"
#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <utility>
#include <variant>

namespace ACS::Load
{

namespace
{

/// 0: not a plan of this MCS.
std::size_t GetCell(const std::string& planID)
{
    return std::strtoul(planID.c_str(), nullptr, 10);
}

} // namespace

PlanKeeper::PlanKeeper(boost::asio::io_context& context, const KeptPlans& kept)
    : _kept(kept)
{
    auto server = ProtocolBeast::McsServer::Create(
        context.get_executor(),
        _clock,
        _random,
        Core::Logger(),
        ProtocolBeast::ServerOptions(),
        *this);
    if (!server)
    {
        throw std::runtime_error(Core::Describe(server.error()));
    }
    _server = std::move(*server);
}

std::uint16_t PlanKeeper::GetPort() const
{
    return _server->GetPort();
}

bool PlanKeeper::IsEveryoneOnline() const noexcept
{
    return _online.size() == _kept.robots;
}

bool PlanKeeper::IsEveryonePlaced() const noexcept
{
    return _placed.size() == _kept.robots;
}

bool PlanKeeper::IsEveryoneIdle() const noexcept
{
    return _idle.size() == _kept.robots;
}

void PlanKeeper::SendFirstPlans()
{
    for (std::size_t cell = 1; cell <= _kept.plans; ++cell)
    {
        SendPlan(cell);
    }
}

std::size_t PlanKeeper::CountRunning() const noexcept
{
    return _running.size();
}

void PlanKeeper::ResetCounts()
{
    KeeperCount count;
    count.errors = _count.errors;
    count.firstError = std::move(_count.firstError);
    _count = std::move(count);
    _positions.Clear();
}

const KeeperCount& PlanKeeper::GetCount() const noexcept
{
    return _count;
}

const TickLog& PlanKeeper::GetPositions() const noexcept
{
    return _positions;
}

void PlanKeeper::OnSessionEvent(const Protocol::SessionEvent& event)
{
    std::visit(
        Core::Overloaded{
            [this](const Protocol::RequestReceived& received) {
                if (received.bDuplicate)
                {
                    CountError("a report was repeated");
                    return;
                }
                OnRequest(received.request);
            },
            [this](const Protocol::AckReceived& received) {
                if (received.ack.result != Protocol::EAckResult::Success)
                {
                    CountError("a plan was refused: " + received.ack.message);
                }
            },
            [this](const Protocol::RequestUnanswered&) { CountError("a plan was not acknowledged"); },
            [this](const Protocol::LinkLost& lost) { CountError("the connection was lost: " + lost.reason); },
            [this](const Protocol::ProtocolNoted& noted) { CountError(GetText(noted.what)); },
            [](const auto& /*of the other side, or of no interest*/) {
            }},
        event);
}

void PlanKeeper::OnRequest(const Protocol::AcsRequest& request)
{
    std::visit(
        Core::Overloaded{
            [this](const Protocol::RobotPositionUpdate& update) { OnPositions(update); },
            [this](const Protocol::RobotStatusUpdate& status) { OnStatus(status); },
            [this](const Protocol::PlanReport& report) { OnPlanReport(report); },
            [this](const Protocol::StepReport&) { ++_count.reports; },
            [this](const Protocol::JobReport&) { ++_count.reports; },
            [this](const Protocol::ErrorReport& error) {
                if (error.bSet && IsEveryonePlaced()) // until then robots are reported as lost
                {
                    CountError(error.errorCode + ": " + error.message);
                }
            },
            [](const auto& /*of no interest*/) {
            }},
        request.payload);
}

void PlanKeeper::OnStatus(const Protocol::RobotStatusUpdate& status)
{
    ++_count.statuses;
    if (status.robotStatus == Protocol::ERobotStatus::Disconnected)
    {
        return;
    }
    _online.insert(status.robotID);
    if (status.robotStatus != Protocol::ERobotStatus::Init)
    {
        _placed.insert(status.robotID);
    }
    if (status.robotStatus == Protocol::ERobotStatus::Idle)
    {
        _idle.insert(status.robotID);
    }
}

void PlanKeeper::OnPlanReport(const Protocol::PlanReport& report)
{
    ++_count.reports;
    if (report.status == Protocol::EPlanStatus::InProgress)
    {
        _running.insert(report.planID);
        return;
    }
    _running.erase(report.planID);
    if (report.status != Protocol::EPlanStatus::Completed)
    {
        CountError(fmt::format("plan {} is {}: {}", report.planID, GetText(report.status), report.message));
        return;
    }
    ++_count.completed;
    if (const std::size_t cell = GetCell(report.planID); cell > 0)
    {
        SendPlan(cell);
    }
}

void PlanKeeper::OnPositions(const Protocol::RobotPositionUpdate& update)
{
    if (!IsEveryonePlaced())
    {
        return;
    }
    ++_count.positions;
    _positions.Note(std::chrono::steady_clock::now());
    if (update.robots.size() != _kept.robots)
    {
        CountError(fmt::format("a position update has {} robots, not {}", update.robots.size(), _kept.robots));
    }
}

Protocol::ExecutionPlan PlanKeeper::MakeTransport(std::size_t cell, std::uint64_t number) const
{
    const bool bToNeighbour = _kept.bToNeighbours && number / _kept.plans % 2 == 1;
    const std::string source = CellSite::GetSource(cell);
    const std::string target = CellSite::GetTarget(bToNeighbour ? CellSite::GetNeighbour(cell) : cell);
    Protocol::ExecutionPlan plan;
    plan.planID = fmt::format("{}-{}", cell, number);
    plan.lotID = "LOT-1";
    plan.priority = 1;
    plan.steps = {
        {1,
         "CassetteLoad",
         source,
         {"CASSETTE-1"},
         {{fmt::format("c0a80101-0000-4000-8000-{:012}", 2 * number), source, "AMR.CP01"}}},
        {2,
         "CassetteUnload",
         target,
         {"CASSETTE-1"},
         {{fmt::format("c0a80101-0000-4000-8000-{:012}", 2 * number + 1), "AMR.CP01", target}}}};
    return plan;
}

void PlanKeeper::SendPlan(std::size_t cell)
{
    if (!_server->TrySend(_server->MakeRequest(MakeTransport(cell, ++_plans))))
    {
        CountError("cannot send a plan");
    }
}

void PlanKeeper::CountError(std::string_view what)
{
    if (_count.errors++ == 0)
    {
        _count.firstError = what;
    }
}

} // namespace ACS::Load
